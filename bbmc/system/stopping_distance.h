// How far the carriage runs on when it is told to stop, and the speed that a distance can stop.
//
//   d(v) = v (t_l + 1 / (2 pi f_h)) + v^2 / (2 a),   a = tau_b / J  R / n
//
// t_l  latency from the end-stop's edge to braking torque
// f_h  frequency of the carriage on the chain against a held motor: v/(2 pi f_h) is how far an
//      undamped carriage swings past a motor that stands at once
// a    deceleration of the whole at braking torque
// The sum is an upper bound of both effects together: friction and damping, which help, are left
// out, and the chain is stretched while the motor still brakes, not after it.
#pragma once

#include "bbmc/system/axis_configuration.h"

namespace towbench::bbmc {

// Torque that a safety stop may use: the drive's limit, or what keeps gear and chain within theirs.
// A step of motor torque tau loads the chain with tau J_l/J once the swing has died out, and with
// twice that at its first peak (undamped), J_l the carriage's share of the inertia. The step also
// takes away what the drive spent on friction before.
[[nodiscard]] double braking_torque_Nm(const AxisConfiguration& axis) noexcept;

class StoppingDistance {
 public:
  StoppingDistance(const AxisConfiguration& axis, double latency_s) noexcept;

  // speed >= 0.
  [[nodiscard]] double distance_m(double speed_m_per_s) const noexcept {
    return speed_m_per_s * lag_s_ + speed_m_per_s * speed_m_per_s / (2.0 * deceleration_m_per_s2_);
  }
  // The inverse; 0 for a distance <= 0.
  [[nodiscard]] double speed_m_per_s(double distance_m) const noexcept {
    return speed_m_per_s(distance_m, deceleration_m_per_s2_);
  }
  [[nodiscard]] double speed_m_per_s(double distance_m,
                                     double deceleration_m_per_s2) const noexcept;

  [[nodiscard]] double deceleration_m_per_s2() const noexcept { return deceleration_m_per_s2_; }

 private:
  double lag_s_;
  double deceleration_m_per_s2_;
};

// Speeds that can be stopped before a hard end, by place and direction (defect 4).
class SpeedLimits {
 public:
  SpeedLimits(const AxisConfiguration& axis, double latency_s) noexcept;

  // Before calibration: what can be stopped between hall and hard end, at the nearer of the two.
  [[nodiscard]] double uncalibrated_m_per_s() const noexcept { return uncalibrated_m_per_s_; }
  // The same for a stop with less than full braking, from the switch on.
  [[nodiscard]] double uncalibrated_m_per_s(double deceleration_m_per_s2) const noexcept;
  // Towards max (direction > 0) or min from a calibrated place: what can be stopped before the
  // hall, and never above the axis's own limit. 0 beyond the hall.
  [[nodiscard]] double calibrated_m_per_s(double position_m, int direction) const noexcept;

  [[nodiscard]] double soft_min_m() const noexcept { return soft_min_m_; }
  [[nodiscard]] double soft_max_m() const noexcept { return soft_max_m_; }
  // Where the run-time guard takes a soft limit as passed: a quarter of the way to the hall, so
  // that an overshoot of a few counts at a planned end is none.
  [[nodiscard]] double guard_min_m() const noexcept { return guard_min_m_; }
  [[nodiscard]] double guard_max_m() const noexcept { return guard_max_m_; }

 private:
  StoppingDistance stopping_;
  double hall_min_m_;
  double hall_max_m_;
  double soft_min_m_;
  double soft_max_m_;
  double guard_min_m_;
  double guard_max_m_;
  double limit_m_per_s_;
  double nearer_end_m_ = 0;
  double uncalibrated_m_per_s_ = 0;
};

}  // namespace towbench::bbmc
