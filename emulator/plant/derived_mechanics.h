// From effective, motor-side parameters to the two bodies of (3.37)-(3.38).
//
//   r   = R/n                            metres of the load a radian of motor
//   M   = (J - J_m) / r^2                from (3.39), wheels counted with the rotor; the water's
//                                        mass (3.9) comes on top once the spring is known
//   B_m = (1 - share) B,  B_c = share B / r^2
//   C_m = (1 - share) C,  C_c = share C / r     likewise S
//   K_s = w0^2 / (r^2/J_m + 1/M)         free-free mode: w0^2 = K_s (r^2/J_m + 1/M)
//   B_s = 2 zeta w0 / (r^2/J_m + 1/M)    its damping: 2 zeta w0 = B_s (r^2/J_m + 1/M)
//
//   F_tilt = -M g sin(tilt)              the carriage alone climbs
//
// A rigid transmission lets no one tell the bodies apart: everything is then on the motor, (3.33).
#pragma once

#include "emulator/plant/axis_parameters.h"

namespace towbench::emulator {

// Dry friction of one body, torque (motor) or force (carriage).
struct DryFriction {
  double coulomb = 0;
  double breakaway = 0;
  double excess = 0;         // breakaway - coulomb
  double inverse_speed = 1;  // of Stribeck's v_s

  [[nodiscard]] bool present() const noexcept { return breakaway > 0; }
};

struct DerivedMechanics {
  double metres_per_motor_rad = 0;  // r
  double motor_inertia_kg_m2 = 0;
  double carriage_mass_kg = 0;
  double motor_viscous_Nm_s_per_rad = 0;
  double carriage_viscous_N_s_per_m = 0;
  DryFriction motor;     // N m, rad/s
  DryFriction carriage;  // N, m/s
  double transmission_stiffness_N_per_m = 0;
  double transmission_damping_N_s_per_m = 0;
  double proportional_gain_V_per_A = 0;  // of the current loop
  double integral_gain_V_per_A_s = 0;
  double tilt_force_N = 0;  // -M g sin(tilt)
};

[[nodiscard]] DerivedMechanics derive(const AxisParameters& parameters) noexcept;

}  // namespace towbench::emulator
