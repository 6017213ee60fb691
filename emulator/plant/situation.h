// What is held between two events: regime, the step's inputs, and the dry-friction levels.
#pragma once

#include <cmath>

#include "core/realtime.h"
#include "emulator/plant/axis_model.h"

namespace towbench::emulator {

// One step's input, limited and scaled as the amplifier does.
struct HeldInput {
  bool enabled = false;
  double set_point_A = 0;         // current mode
  double command_terminal_V = 0;  // voltage mode
  double limit_V = 0;             // largest terminal voltage
  double supply_V = 0;
  double carriage_force_N = 0;
};

struct Situation {
  Regime regime;
  HeldInput held;
  // Dry friction, absolute: while a body moves the level that brakes it, while it sticks the level
  // at which it breaks away. N m and N.
  double motor_friction_Nm = 0;
  double carriage_friction_N = 0;
  std::size_t position_interval = 0;  // of the position friction, where the carriage was last
};

[[nodiscard]] inline double carriage_position_m(const AxisModel& model,
                                                const StateVector& z) noexcept {
  return model.mechanics.metres_per_radian * z[kMotorAngle] - z[kStretch];
}

[[nodiscard]] inline double chain_force_N(const AxisModel& model, const StateVector& z) noexcept {
  const auto& m = model.mechanics;
  return m.chain_stiffness_N_per_m * z[kStretch] +
         m.chain_damping_N_s_per_m * (m.metres_per_radian * z[kMotorSpeed] - z[kCarriageSpeed]);
}

// Penetration, + when beyond the stop that `sign` names. `one` is 1, or 0 for the linear part
// alone.
[[nodiscard]] inline double penetration_m(const AxisModel& model, const StateVector& z, double one,
                                          double sign) noexcept {
  const auto& ends = model.parameters.hard_ends;
  return sign * (carriage_position_m(model, z) - one * (sign > 0 ? ends.max_m : ends.min_m));
}

// How hard that stop would push, + away from it; negative would be a pull, which no stop can.
[[nodiscard]] inline double end_push_N(const AxisModel& model, const StateVector& z, double one,
                                       double sign) noexcept {
  const auto& ends = model.parameters.hard_ends;
  return ends.stiffness_N_per_m * penetration_m(model, z, one, sign) +
         ends.damping_N_s_per_m * sign * z[kCarriageSpeed];
}

// Everything on the carriage but its own friction and chain, N; `one` as above.
[[nodiscard]] inline double outside_force_N(const AxisModel& model, const Situation& s,
                                            const StateVector& z, double one) noexcept {
  double force = one * s.held.carriage_force_N;
  if (s.regime.end == HardEnd::kPushing) {
    force -= s.regime.end_sign * end_push_N(model, z, one, s.regime.end_sign);
  }
  return force;
}

// What friction must hold for the motor to stay at rest, N m.
[[nodiscard]] inline double motor_load_Nm(const AxisModel& model, const Situation& s,
                                          const StateVector& z, double one) noexcept {
  const double r = model.mechanics.metres_per_radian;
  const double on_sprocket_N =
      model.parameters.chain.rigid ? outside_force_N(model, s, z, one) : -chain_force_N(model, z);
  return model.parameters.torque_constant_Nm_per_A * z[kCurrent] + r * on_sprocket_N;
}

// What friction must hold for the carriage to stay at rest, N. Elastic chain only.
[[nodiscard]] inline double carriage_load_N(const AxisModel& model, const Situation& s,
                                            const StateVector& z, double one) noexcept {
  return chain_force_N(model, z) + outside_force_N(model, s, z, one);
}

// (3.34) without sign and viscous part.
[[nodiscard]] inline double friction_level(const AxisModel& model, const DryFriction& law,
                                           double speed) noexcept {
  return law.coulomb + law.excess * model.stribeck(std::fabs(speed) * law.inverse_speed);
}

[[nodiscard]] inline double motor_level_Nm(const AxisModel& model, double speed_rad_per_s,
                                           double carriage_m, std::size_t& interval) noexcept {
  const double level = friction_level(model, model.mechanics.motor, speed_rad_per_s);
  return model.parameters.chain.rigid ? level + model.position_friction(carriage_m, interval)
                                      : level;
}

[[nodiscard]] inline double carriage_level_N(const AxisModel& model, double speed_m_per_s,
                                             double carriage_m, std::size_t& interval) noexcept {
  return friction_level(model, model.mechanics.carriage, speed_m_per_s) +
         model.position_friction(carriage_m, interval);
}

[[nodiscard]] inline double electrical_input(const Situation& s) noexcept {
  switch (s.regime.drive) {
    case Drive::kRegulated:
      return s.held.set_point_A;
    case Drive::kLimited:
      return s.regime.drive_sign * s.held.limit_V;
    case Drive::kVoltage:
      return s.held.command_terminal_V;
    case Drive::kFreewheel:
      return -s.regime.drive_sign * s.held.supply_V;
    case Drive::kCurrentLimited:
    case Drive::kOpen:
      break;
  }
  return 0.0;
}

// u of linear_mode.h.
TOWBENCH_REALTIME [[nodiscard]] inline InputVector held_inputs(const AxisModel& model,
                                                               const Situation& s) noexcept {
  double force = s.held.carriage_force_N - s.regime.carriage_direction * s.carriage_friction_N;
  if (s.regime.end == HardEnd::kPushing) {
    const auto& ends = model.parameters.hard_ends;
    force += ends.stiffness_N_per_m * (s.regime.end_sign > 0 ? ends.max_m : ends.min_m);
  }
  return {electrical_input(s), -s.regime.motor_direction * s.motor_friction_Nm, force};
}

}  // namespace towbench::emulator
