// Ziegler-Nichols on the machine itself (thesis 4.2.1): the gain K_C at which proportional control
// alone would oscillate, and the period T_C of it, found by a relay (Astrom and Hagglund 1984).
//
//   tau = d sgn(q_0 - n)      oscillates by itself with an amplitude a
//   K_C = 4 d / (pi a)        the relay's describing function, T_C the period
//
// A relay finds the edge of stability without ever crossing it. Dry friction makes K_C depend on
// the amplitude, so that is what is asked for: d is changed until a is as wanted.
#pragma once

#include <cstdint>

#include "core/realtime.h"

namespace towbench::bbmc {

struct RelayParameters {
  double amplitude_rad = 0.7;  // of the motor, > 0
  double torque_Nm = 8e-3;     // to begin with, > 0
  double torque_limit_Nm = 50e-3;
};

struct RelayResult {
  double critical_gain_Nm_per_rad = 0;
  double critical_period_s = 0;
  double amplitude_rad = 0;
  double relay_Nm = 0;
  [[nodiscard]] bool found() const noexcept { return critical_gain_Nm_per_rad > 0; }
};

class RelayTuner {
 public:
  RelayTuner() noexcept = default;
  RelayTuner(const RelayParameters& parameters, double centre_rad) noexcept;

  // The motor is at `angle_rad`, `step_s` after the last time. Torque until the next time.
  TOWBENCH_REALTIME [[nodiscard]] double step(double angle_rad, double step_s) noexcept;

  // Found, or given up: nothing more to do.
  [[nodiscard]] bool over() const noexcept { return over_; }
  [[nodiscard]] const RelayResult& result() const noexcept { return result_; }

 private:
  void end_cycle() noexcept;
  void end_round() noexcept;

  RelayParameters parameters_;
  RelayResult result_;
  double centre_rad_ = 0;
  double relay_Nm_ = 0;
  double lowest_rad_ = 0;
  double highest_rad_ = 0;
  double cycle_s_ = 0;
  double total_s_ = 0;  // of this round's counted cycles
  double total_swing_rad_ = 0;
  double since_cycle_s_ = 0;
  std::int32_t cycles_ = 0;
  std::int32_t rounds_ = 0;
  bool pushes_up_ = true;
  bool over_ = true;
};

// Table 4.1 with its errata: the row "PID" is K_P = 0.6 K_C, T_I = T_C / 2, T_D = T_C / 8, and
// K_I = K_P / T_I, K_D = K_P T_D.
struct ZieglerNicholsGains {
  double proportional_Nm_per_rad = 0;
  double integral_Nm_per_rad_s = 0;
  double derivative_Nm_s_per_rad = 0;
};
[[nodiscard]] ZieglerNicholsGains ziegler_nichols_pid(const RelayResult& result) noexcept;

}  // namespace towbench::bbmc
