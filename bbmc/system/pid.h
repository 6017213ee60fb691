// The law (4.12), motor angle to motor torque, with saturation and anti-windup inside (defect 6):
//
//   tau = K_P e + I + K_D e' + tau_ff,   |tau| <= limit,   I' = K_I e
//
// e = reference - (count + 1/2), in rad at the motor; e' = reference speed - estimated speed.
// I stands still while the output is saturated and e would drive it further (conditional
// integration): no windup, and no extra gain to tune. I is kept as a torque, so that a change of
// K_I in motion moves nothing; a change of K_P and K_D is taken up by I (bumpless).
#pragma once

#include "bbmc/system/axis_configuration.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class Pid {
 public:
  explicit Pid(const PidGains& gains) noexcept : gains_(gains) {}

  struct Input {
    double error_rad = 0;
    double speed_error_rad_per_s = 0;
    double feed_forward_Nm = 0;
    double limit_Nm = 0;        // > 0
    double step_s = 0;          // since the last update
    double integral_ratio = 1;  // of the error that the integral takes up; 0 holds it
  };

  TOWBENCH_REALTIME [[nodiscard]] double update(const Input& input) noexcept;

  // For a new motion: nothing remembered.
  void reset() noexcept;
  void set_gains(const PidGains& gains) noexcept;
  [[nodiscard]] const PidGains& gains() const noexcept { return gains_; }
  [[nodiscard]] double integral_Nm() const noexcept { return integral_Nm_; }
  [[nodiscard]] bool saturated() const noexcept { return saturated_; }

 private:
  PidGains gains_;
  double integral_Nm_ = 0;
  double last_error_rad_ = 0;
  double last_speed_error_rad_per_s_ = 0;
  bool saturated_ = false;
};

// (3.33) run forwards along a reference, at the motor.
TOWBENCH_REALTIME [[nodiscard]] double feed_forward_torque_Nm(
    const FeedForward& model, double speed_rad_per_s, double acceleration_rad_per_s2) noexcept;

}  // namespace towbench::bbmc
