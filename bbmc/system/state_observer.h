// Full state of one axis from its encoder (thesis 9.3.1): a Kalman filter with the steady-state
// gain of the two masses (3.37)-(3.38) and a load d that walks at random.
//
//   J_m w_m' = tau - k (q_m - q_l) - c (w_m - w_l) - (1 - s) d + noise
//   J_l w_l' =       k (q_m - q_l) + c (w_m - w_l) - s d,   d' = noise,   y = q_m + quantisation
//
// s is the carriage's share of the load. The model is stepped by its exact discretisation, so it is
// stable at every control rate. Quantisation counts as noise of a count/sqrt(12) (Widrow).
// Where friction changes its sign, d needs some hundredths of a second to follow.
#pragma once

#include <array>

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/kalman_gain.h"
#include "core/realtime.h"

namespace towbench::bbmc {

// At the motor's shaft.
struct AxisState {
  double motor_rad = 0;
  double motor_rad_per_s = 0;
  double carriage_rad = 0;
  double carriage_rad_per_s = 0;
  double load_Nm = 0;  // + holds the axis from moving towards max
};

class StateObserver {
 public:
  static constexpr std::size_t kStates = 5;  // in the order of AxisState

  // Solves for the gain if the settings enable it: at start, not in the control path.
  StateObserver(const AxisConfiguration& axis, double control_rate_Hz) noexcept;

  // The motor is at `motor_rad` (middle of its count) after `step_s` > 0 of `applied_Nm`. The first
  // sample after a reset, and one that came more than kMostMissed periods late, start anew from
  // `speed_rad_per_s`, another estimate.
  TOWBENCH_REALTIME const AxisState& update(double motor_rad, double speed_rad_per_s,
                                            double applied_Nm, double step_s) noexcept;
  void reset() noexcept { started_ = false; }

  // False: disabled, or no gain was found; it is not to be used then.
  [[nodiscard]] bool works() const noexcept { return gain_.settled; }
  [[nodiscard]] const AxisState& state() const noexcept { return state_; }

  [[nodiscard]] const SquareMatrix<kStates>& transition() const noexcept { return transition_; }
  [[nodiscard]] const SquareMatrix<kStates>& noise() const noexcept { return noise_; }
  [[nodiscard]] double measurement_variance() const noexcept { return measurement_variance_; }
  [[nodiscard]] const std::array<double, kStates>& gain() const noexcept { return gain_.gain; }

 private:
  static constexpr int kMostMissed = 20;

  void step(double applied_Nm) noexcept;

  double period_s_;
  double measurement_variance_ = 0;
  SquareMatrix<kStates> transition_{};
  std::array<double, kStates> input_{};
  SquareMatrix<kStates> noise_{};
  SteadyGain<kStates> gain_;
  AxisState state_;
  bool started_ = false;
};

}  // namespace towbench::bbmc
