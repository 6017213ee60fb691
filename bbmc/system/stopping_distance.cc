#include "bbmc/system/stopping_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::bbmc {

double braking_torque_Nm(const AxisConfiguration& axis) noexcept {
  const double carriage_share = 1.0 - axis.braking.rotor_inertia_kg_m2 / axis.braking.inertia_kg_m2;
  const double peak_ratio = 2.0 * carriage_share;
  const double drive_Nm = axis.drive.torque_limit_Nm();
  const double gear_Nm = axis.braking.gear_torque_limit_Nm / axis.gear_ratio;
  const double step_Nm = drive_Nm + axis.plausibility.worst_breakaway_Nm;
  return step_Nm * peak_ratio <= gear_Nm
             ? drive_Nm
             : gear_Nm / peak_ratio - axis.plausibility.worst_breakaway_Nm;
}

StoppingDistance::StoppingDistance(const AxisConfiguration& axis, double latency_s) noexcept
    : lag_s_(latency_s + 1.0 / (2.0 * std::numbers::pi * axis.braking.held_motor_chain_Hz)),
      deceleration_m_per_s2_(braking_torque_Nm(axis) / axis.braking.inertia_kg_m2 *
                             axis.metres_per_motor_rad()) {}

double StoppingDistance::speed_m_per_s(double distance_m,
                                       double deceleration_m_per_s2) const noexcept {
  if (!(distance_m > 0)) {
    return 0.0;
  }
  const double a = deceleration_m_per_s2;
  return a * (std::sqrt(lag_s_ * lag_s_ + 2.0 * distance_m / a) - lag_s_);
}

SpeedLimits::SpeedLimits(const AxisConfiguration& axis, double latency_s) noexcept
    : stopping_(axis, latency_s),
      hall_min_m_(axis.position_m(axis.ends.hall_min_count)),
      hall_max_m_(axis.position_m(axis.ends.hall_max_count)),
      soft_min_m_(axis.position_m(axis.ends.soft_min_count)),
      soft_max_m_(axis.position_m(axis.ends.soft_max_count)),
      guard_min_m_(soft_min_m_ - (soft_min_m_ - hall_min_m_) / 4.0),
      guard_max_m_(soft_max_m_ + (hall_max_m_ - soft_max_m_) / 4.0),
      limit_m_per_s_(axis.speed_limit_m_per_s) {
  const double beyond_min_m = hall_min_m_ - axis.position_m(axis.ends.hard_min_count);
  const double beyond_max_m = axis.position_m(axis.ends.hard_max_count) - hall_max_m_;
  nearer_end_m_ = std::min(beyond_min_m, beyond_max_m);
  uncalibrated_m_per_s_ = uncalibrated_m_per_s(stopping_.deceleration_m_per_s2());
}

double SpeedLimits::uncalibrated_m_per_s(double deceleration_m_per_s2) const noexcept {
  return std::min(limit_m_per_s_, stopping_.speed_m_per_s(nearer_end_m_, deceleration_m_per_s2));
}

double SpeedLimits::calibrated_m_per_s(double position_m, int direction) const noexcept {
  const double distance_m = direction > 0 ? hall_max_m_ - position_m : position_m - hall_min_m_;
  return std::min(limit_m_per_s_, stopping_.speed_m_per_s(distance_m));
}

}  // namespace towbench::bbmc
