// Goto's reference: speeds up, runs, and slows down to stop on the target, step by step.
//
//   v_k = min(v_(k-1) + a T, v_max, speed from which a stops in what is left)
//
// The reference is the integral of the speed, so speed control of the long leg is the same law (PI
// on speed is PID on its integral) and the change to position control moves nothing (defect 9).
#pragma once

#include "bbmc/system/trajectory/reference.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class ApproachProfile {
 public:
  // Finite; speed and acceleration > 0.
  void begin(double start_m, double target_m, double speed_m_per_s,
             double acceleration_m_per_s2) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] Reference step(double step_s) noexcept;

  [[nodiscard]] double target_m() const noexcept { return target_m_; }
  [[nodiscard]] double left_m() const noexcept { return target_m_ - position_m_; }
  [[nodiscard]] bool arrived() const noexcept { return position_m_ == target_m_; }

 private:
  double target_m_ = 0;
  double position_m_ = 0;
  double speed_m_per_s_ = 0;  // towards the target
  double speed_limit_m_per_s_ = 0;
  double acceleration_m_per_s2_ = 0;
};

}  // namespace towbench::bbmc
