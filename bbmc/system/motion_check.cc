#include "bbmc/system/motion_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

constexpr double kLongest_s = 86'400.0;
constexpr double kFinestStep_s = 2e-3;
constexpr double kMostSamples = 400'000;
constexpr double kRounding = 1e-9;

[[nodiscard]] double step_for(double duration_s) noexcept {
  return std::max(kFinestStep_s, duration_s / kMostSamples);
}

// From 0 to the first one at or beyond the end.
[[nodiscard]] std::int64_t samples_for(double duration_s, double step_s) noexcept {
  return static_cast<std::int64_t>(duration_s / step_s) + 2;
}

[[nodiscard]] bool usable_duration(double duration_s) noexcept {
  return duration_s >= 0 && duration_s <= kLongest_s;  // false for NaN
}

ErrorCode check_place(const AxisControl& axis, double start_m, double tolerance_m,
                      double position_m) noexcept {
  const EndStopGuard& stops = axis.end_stops();
  if ((stops.active(End::kMax) && position_m > start_m + tolerance_m) ||
      (stops.active(End::kMin) && position_m < start_m - tolerance_m)) {
    return ErrorCode::kRequestBeyondSoftLimit;
  }
  if (!axis.calibrated()) {
    return ErrorCode::kNone;
  }
  // Who stands beyond a soft limit may come back, not go further.
  const double lowest_m = std::min(axis.speed_limits().soft_min_m(), start_m) - kRounding;
  const double highest_m = std::max(axis.speed_limits().soft_max_m(), start_m) + kRounding;
  return position_m < lowest_m || position_m > highest_m ? ErrorCode::kRequestBeyondSoftLimit
                                                         : ErrorCode::kNone;
}

ErrorCode check_sample(const AxisControl& axis, const SafetyConfiguration& safety, double start_m,
                       const Reference& reference) noexcept {
  if (!std::isfinite(reference.position_m) || !std::isfinite(reference.velocity_m_per_s) ||
      !std::isfinite(reference.acceleration_m_per_s2)) {
    return ErrorCode::kRequestBadArgument;
  }
  const ErrorCode place =
      check_place(axis, start_m, safety.start_tolerance_m, reference.position_m);
  if (place != ErrorCode::kNone || reference.velocity_m_per_s == 0) {
    return place;
  }
  const double allowed_m_per_s = planned_speed_limit_m_per_s(
      axis, reference.position_m, reference.velocity_m_per_s > 0 ? 1 : -1);
  return std::fabs(reference.velocity_m_per_s) > allowed_m_per_s * (1 + kRounding)
             ? ErrorCode::kRequestTooFast
             : ErrorCode::kNone;
}

}  // namespace

double planned_speed_limit_m_per_s(const AxisControl& axis, double position_m,
                                   int direction) noexcept {
  return axis.calibrated() ? axis.speed_limits().calibrated_m_per_s(position_m, direction)
                           : axis.speed_limits().uncalibrated_m_per_s();
}

ErrorCode check_reference(const AxisControl& axis, const SafetyConfiguration& safety,
                          const Trajectory& trajectory) noexcept {
  const double duration_s = trajectory.duration_s();
  if (!usable_duration(duration_s)) {
    return ErrorCode::kRequestBadArgument;
  }
  const double start_m = axis.position_m();
  if (!(std::fabs(trajectory.at(0.0).position_m - start_m) <= safety.start_tolerance_m)) {
    return ErrorCode::kRequestOutOfRange;
  }
  const double step_s = step_for(duration_s);
  const std::int64_t samples = samples_for(duration_s, step_s);
  for (std::int64_t k = 0; k < samples; ++k) {
    const Reference reference = trajectory.at(static_cast<double>(k) * step_s);
    const ErrorCode found = check_sample(axis, safety, start_m, reference);
    if (found != ErrorCode::kNone) {
      return found;
    }
  }
  return ErrorCode::kNone;
}

ErrorCode check_duty(const AxisControl& axis, double duty_limit_pct,
                     const DutyProgram& program) noexcept {
  const double duration_s = program.duration_s();
  if (!usable_duration(duration_s)) {
    return ErrorCode::kRequestBadArgument;
  }
  const EndStopGuard& stops = axis.end_stops();
  const double step_s = step_for(duration_s);
  const std::int64_t samples = samples_for(duration_s, step_s);
  for (std::int64_t k = 0; k < samples; ++k) {
    const double duty_pct = program.duty_pct(static_cast<double>(k) * step_s);
    if (!(std::fabs(duty_pct) <= duty_limit_pct)) {
      return ErrorCode::kRequestOutOfRange;
    }
    if ((stops.active(End::kMax) && duty_pct > 0) || (stops.active(End::kMin) && duty_pct < 0)) {
      return ErrorCode::kRequestBeyondSoftLimit;
    }
  }
  return ErrorCode::kNone;
}

ErrorCode check_target(const AxisControl& axis, double target_m) noexcept {
  if (!std::isfinite(target_m)) {
    return ErrorCode::kRequestBadArgument;
  }
  if (!axis.calibrated()) {
    return ErrorCode::kRequestNotCalibrated;
  }
  const bool inside = target_m >= axis.speed_limits().soft_min_m() - kRounding &&
                      target_m <= axis.speed_limits().soft_max_m() + kRounding;
  return inside ? ErrorCode::kNone : ErrorCode::kRequestBeyondSoftLimit;
}

}  // namespace towbench::bbmc
