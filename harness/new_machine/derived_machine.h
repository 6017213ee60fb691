// What follows from a machine's data: the axis at its motor, the gains of its loop, a first motion.
//
//   r    = lead / 2 pi n, or R / n            metres a motor radian
//   J    = J_m + m r^2                        (3.39)
//   T    = K_T min(I_max, K_amp 10 V)         torque at full duty
//   w    = (0.9 V - R I_f) / K_T              speed at the voltage limit, I_f against friction
//   K_D  = 3 a J, K_P = 3 a^2 J, K_I = a^3 J  J s^3 + K_D s^2 + K_P s + K_I = J (s + a)^3, a = 2 pi
//   f
//
// A torque d that steps leaves at most d / K_P of error under this loop: its response d/J t^2/2
// e^-at is largest at t = 2/a, 0.81 d / K_P.
#pragma once

#include "harness/new_machine/machine_data.h"

namespace towbench::harness {

struct DerivedMachine {
  double metres_per_motor_rad = 0;  // r
  double inertia_kg_m2 = 0;         // J
  double torque_Nm = 0;             // T
  double force_N = 0;               // T / r
  double friction_N = 0;
  double coulomb_Nm = 0;
  double breakaway_Nm = 0;          // 1.5 C, assumed
  double viscous_Nm_s_per_rad = 0;  // C more at the voltage limit, assumed
  double top_speed_rad_per_s = 0;   // w
  double speed_limit_m_per_s = 0;   // 0.8 of it, and what the encoder's channels carry
  double proportional_Nm_per_rad = 0;
  double integral_Nm_per_rad_s = 0;
  double derivative_Nm_s_per_rad = 0;
  double counts_per_m = 0;
  double stop_stiffness_N_per_m = 0;  // 2 mm deep from the speed limit, assumed
  double stop_damping_N_s_per_m = 0;  // half of critical, assumed
  double trial_start_m = 0;
  double trial_distance_m = 0;
  double trial_speed_m_per_s = 0;
  double trial_ramp_s = 0.3;
  double trial_error_m = 0;  // by K_P alone
};

// Of 10 V at the amplifier's input, as the bench's PWM makes them.
inline constexpr double kFullDuty_V = 10.0;
inline constexpr double kLargestChannel_Hz = 1e6;  // assumed, of a line driver

[[nodiscard]] DerivedMachine derive(const MachineData& data);

}  // namespace towbench::harness
