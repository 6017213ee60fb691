// What acts inside one axis at the end of a step: for truth.csv and for energy balances.
//
// Positive drives towards max, so friction opposes a positive speed with a negative value.
#pragma once

namespace towbench::emulator {

struct AxisForces {
  double terminal_V = 0;            // amplifier output
  double motor_torque_Nm = 0;       // K_T i
  double motor_friction_Nm = 0;     // on the motor; viscous part included
  double transmission_force_N = 0;  // on the carriage; its reaction is on the wheel
  double carriage_friction_N = 0;   // on the carriage; viscous part included
  double end_force_N = 0;           // of a hard end on the carriage
  double external_force_N = 0;      // from outside on the carriage, as given
  double standing_force_N = 0;      // of cable, tilt and place on the carriage
  double ripple_torque_Nm = 0;      // on the motor
  bool motor_sticks = true;
  bool carriage_sticks = true;
  bool voltage_limited = false;
};

}  // namespace towbench::emulator
