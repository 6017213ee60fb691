// The axis of a model, stepped in time and seen at the motor: one body, or two on a chain
// (two_bodies.h).
//
// Dry friction acts as a clamp on the step's speed, so a body truly sticks. Of a rigid axis:
//   v* = v + h (F - B v - b) / M,  v' = sgn(v*) max(|v*| - h C / M, 0).
#pragma once

#include <optional>

#include "study/diagnose/two_bodies.h"

namespace towbench::harness::diagnose {

class AxisBody {
 public:
  // `baseline` and `theta` outlive this. The load of a rigid axis is the motor.
  AxisBody(const Baseline& baseline, const Theta& theta, const Motion& motor, const Motion& load);

  // A force on each, `h_s` at most kLongestStep_s. Of a rigid axis they add up.
  void step(double on_motor_N, double on_load_N, double h_s);
  [[nodiscard]] const Motion& motor() const noexcept { return motor_; }

 private:
  void step_rigid(double force_N, double h_s);

  const Theta& theta_;
  Motion motor_;
  Motion load_;
  std::optional<TwoBodies> bodies_;
};

}  // namespace towbench::harness::diagnose
