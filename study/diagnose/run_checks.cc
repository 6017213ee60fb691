#include "study/diagnose/run_checks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Kind = logs::Finding::Kind;
using Eigen::Index;

constexpr double kSpeedWindow_s =
    0.02;                       // of a speed, so that an encoder's steps do not look like one
constexpr double kMost = 0.99;  // of the values; the rest may be glitches
constexpr double kBeyondDrive = 3;
constexpr double kBeyondCommand = 2;
constexpr double kReferenceOff = 4;  // by which followed and asked way may differ, either way

// What a column changes by from window to window.
std::vector<double> ways_of(const Eigen::VectorXd& x, Index window) {
  std::vector<double> ways;
  for (Index i = window; i < x.size(); i += window) {
    ways.push_back(x[i] - x[i - window]);
  }
  return ways;
}

std::vector<double> sizes_of(std::vector<double> values) {
  for (double& value : values) {
    value = std::abs(value);
  }
  return values;
}

void check_speed(const Run& run, const NominalModel& model, Index window,
                 logs::Findings& findings) {
  const double speed = statistics::quantile(sizes_of(ways_of(run.position_m, window)), kMost) /
                       (static_cast<double>(window) * run.period_s);
  if (model.no_load_speed_m_per_s > 0 && speed > kBeyondDrive * model.no_load_speed_m_per_s) {
    findings.push_back(
        {Kind::kFatal, "position_unit_off",
         fmt::format("{}: the position moves at {:.3g} m/s, the machine at {:.3g} m/s at most: is "
                     "it in counts or mm, in part or throughout?",
                     run.name, speed, model.no_load_speed_m_per_s)});
  }
}

void check_input(const Run& run, const NominalModel& model, logs::Findings& findings) {
  const double most = std::max(model.force_limit_N, 100 * model.newton_per_duty_pct);
  const std::vector<double> input(run.input_N.begin(), run.input_N.end());
  const double reached = statistics::quantile(sizes_of(input), kMost);
  if (most > 0 && reached > kBeyondCommand * most) {
    findings.push_back(
        {Kind::kFatal, "input_unit_off",
         fmt::format("{}: the input reaches {:.3g} N, a full command makes {:.3g} N: is it in "
                     "thousandths, in part or throughout?",
                     run.name, reached, most)});
  }
}

// Ratio of the way that was gone to the way that was asked for, where much was asked.
void check_reference(Run& run, Index window, logs::Findings& findings) {
  if (run.reference_m.size() != run.size()) {
    return;
  }
  const std::vector<double> asked = ways_of(run.reference_m, window);
  const std::vector<double> gone = ways_of(run.position_m, window);
  const double much = 0.2 * statistics::quantile(sizes_of(asked), 0.95);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (std::abs(asked[i]) > much) {
      ratios.push_back(gone[i] / asked[i]);
    }
  }
  constexpr std::size_t kEnough = 20;
  if (ratios.size() < kEnough) {
    return;
  }
  const double ratio = statistics::quantile(ratios, 0.5);
  const bool always_along = statistics::quantile(ratios, 0.1) >= 0;
  const bool always_against = statistics::quantile(ratios, 0.9) < 0;
  if (always_against && ratio < -1 / kReferenceOff) {
    findings.push_back({Kind::kFatal, "position_sign_reversed",
                        fmt::format("{}: the position runs against its reference: the sign of one "
                                    "of the two is reversed",
                                    run.name)});
  } else if (ratio < 1 / kReferenceOff || ratio > kReferenceOff) {
    findings.push_back(
        always_along
            ? logs::Finding{Kind::kNote, "reference_unit_off",
                            fmt::format(
                                "{}: the position goes {:.3g} times as far as its reference "
                                "asks: another unit? It goes on without the reference",
                                run.name, ratio)}
            : logs::Finding{
                  Kind::kNote, "reference_not_followed",
                  fmt::format("{}: the position goes now with its reference and now against "
                              "it: another axis' reference, or a loop that had lost control? "
                              "It goes on without the reference",
                              run.name)});
    run.reference_m.resize(0);
  }
}

}  // namespace

void check_run(Run& run, const NominalModel& model, logs::Findings& findings) {
  const auto window = std::max<Index>(1, std::lround(kSpeedWindow_s / run.period_s));
  check_speed(run, model, window, findings);
  check_input(run, model, findings);
  check_reference(run, window, findings);
}

}  // namespace towbench::study::diagnose
