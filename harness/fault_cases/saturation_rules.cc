// How an axis comes back when its drive could not do what the law asked for.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using core::Axis;
using core::Nanoseconds;
using enum FaultKind;

constexpr double kSaturated_pct = 99.9;
constexpr Nanoseconds kLong_ns = 50 * core::kNanosecondsPerMillisecond;
// Whose passing is a step of load: a plain PID answers that by itself.
constexpr double kAlwaysAllowed_m = 5e-3;
constexpr double kShareOfLag = 0.25;

// A stretch of full drive against a lag, and how far the axis then ran past its reference.
struct Stretch {
  Nanoseconds from_ns = -1;
  Nanoseconds to_ns = -1;
  double lag_m = 0;   // signed, the largest
  double past_m = 0;  // since the end, on the other side

  [[nodiscard]] bool is_long() const noexcept { return to_ns - from_ns >= kLong_ns; }
  [[nodiscard]] double allowed_m() const noexcept {
    return std::max(kAlwaysAllowed_m, kShareOfLag * std::fabs(lag_m));
  }
};

// The one that ran past the most beyond what is allowed.
Stretch worst_stretch(const CaseRecord& run, Axis axis) {
  Stretch worst;
  Stretch now;
  bool open = false;
  const auto close = [&] {
    if (now.is_long() && now.past_m - now.allowed_m() > worst.past_m - worst.allowed_m()) {
      worst = now;
    }
  };
  for (const auto& row : run.log) {
    const auto& state = row.axes[axis];
    const double error_m = state.reference_m - state.position_m;
    const bool follows = state.mode == bbmc::AxisMode::kPosition;
    const bool against =
        follows && std::fabs(state.duty_pct) >= kSaturated_pct && state.duty_pct * error_m > 0;
    if (against && !open) {
      close();
      now = {.from_ns = row.time_ns};
    }
    open = against;
    if (against) {
      now.to_ns = row.time_ns;
      now.lag_m = std::fabs(error_m) > std::fabs(now.lag_m) ? error_m : now.lag_m;
    } else if (follows && now.from_ns >= 0) {
      now.past_m = std::max(now.past_m, now.lag_m > 0 ? -error_m : error_m);
    }
  }
  close();
  return worst;
}

}  // namespace

MaybeCheck integral_does_not_wind_up(const CaseEvidence& evidence) {
  constexpr auto kName = "no_wind_up";
  constexpr auto kMeaning =
      "after full drive the axis runs past its reference by no more than 5 mm or a quarter of its "
      "lag";
  const auto& plan = evidence.prepared.plan;
  const bool applies = std::all_of(plan.begin(), plan.end(), [](const Fault& fault) {
    const bool limits =
        fault.kind == kGainDrop || fault.kind == kSaturatedEarly || fault.kind == kBrakeDrag;
    return limits && fault.duration_s.has_value();
  });
  if (!applies) {
    return std::nullopt;
  }
  double most_used = 0;
  for (const auto axis : core::kPlanarAxes) {
    const auto worst = worst_stretch(evidence.run, axis);
    const double used = worst.is_long() ? worst.past_m / worst.allowed_m() : 0;
    if (used > 1) {
      return with_used(
          failed(kName, kMeaning,
                 fmt::format("{} lagged by {:.1f} mm at full drive to {:.4f} s, then ran {:.1f} "
                             "mm past its reference",
                             core::name_of(axis), 1e3 * std::fabs(worst.lag_m),
                             core::seconds(worst.to_ns), 1e3 * worst.past_m)),
          used);
    }
    most_used = std::max(most_used, used);
  }
  return with_used(passed(kName, kMeaning), most_used);
}

}  // namespace towbench::harness
