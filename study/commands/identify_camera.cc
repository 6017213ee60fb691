#include "study/commands/identify_camera.h"

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/axis.h"
#include "harness/checks/check.h"
#include "study/runs/watched_run.h"

namespace towbench::study {
namespace {

using identify::ElasticError;
using identify::Within95;

// Of the motor held still, from 1/w^2; none where the interval reaches zero.
std::string held_frequency(const Within95& per_acceleration_s2) {
  const auto hertz = [](double s2) { return 1.0 / (2 * std::numbers::pi * std::sqrt(s2)); };
  const double low = per_acceleration_s2.value - per_acceleration_s2.half_width;
  if (low <= 0) {
    return "not told";
  }
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", hertz(per_acceleration_s2.value),
                     hertz(per_acceleration_s2.value + per_acceleration_s2.half_width), hertz(low));
}

std::string in_mm(const Within95& each) {
  return fmt::format("{:.3f} +-{:.3f}", 1e3 * each.value, 1e3 * each.half_width);
}

void print_row(std::string_view axis, const ElasticError& e) {
  if (!e.trouble.empty()) {
    fmt::print("{}: {}\n", axis, e.trouble);
    return;
  }
  fmt::print(
      "{}: {} frames\n"
      "   delay of a frame, ms              {:.1f} +-{:.1f}\n"
      "   camera against encoder, mm        {}\n"
      "   held-motor frequency, Hz          {}\n"
      "   stretch by friction, mm           {}\n"
      "   elastic error, mm                 rms {:.3f}, peak {:.3f}\n"
      "   not explained (pixels, swing), mm rms {:.3f}\n",
      axis, e.frames, 1e3 * e.delay_s.value, 1e3 * e.delay_s.half_width, in_mm(e.offset_m),
      held_frequency(e.per_acceleration_s2), in_mm(e.friction_stretch_m), 1e3 * e.rms_m,
      1e3 * e.peak_m, 1e3 * e.residual_rms_m);
}

nlohmann::json to_json(const ElasticError& e) {
  if (!e.trouble.empty()) {
    return {{"trouble", e.trouble}};
  }
  const auto pair = [](const Within95& each) {
    return nlohmann::json{{"value", each.value}, {"half_width", each.half_width}};
  };
  return {{"frames", e.frames},
          {"delay_s", pair(e.delay_s)},
          {"offset_m", pair(e.offset_m)},
          {"per_acceleration_s2", pair(e.per_acceleration_s2)},
          {"friction_stretch_m", pair(e.friction_stretch_m)},
          {"rms_m", e.rms_m},
          {"peak_m", e.peak_m},
          {"residual_rms_m", e.residual_rms_m}};
}

}  // namespace

int tell_elastic_error(const std::filesystem::path& run_folder, bool json) {
  nlohmann::json all = nlohmann::json::object();
  bool told = false;
  for (const auto& [axis, error] : read_watched_run(run_folder)) {
    told = told || error.trouble.empty();
    all[std::string(core::name_of(axis))] = to_json(error);
    if (!json) {
      print_row(core::name_of(axis), error);
    }
  }
  if (json) {
    fmt::print("{}\n", all.dump(2));
  }
  return told ? harness::kExitPass : harness::kExitInvalid;
}

}  // namespace towbench::study
