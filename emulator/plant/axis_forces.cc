#include "emulator/plant/axis_forces.h"

#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {
namespace {

double terminal_V(const AxisModel& model, const Situation& s, const StateVector& z) noexcept {
  const auto& axis = model.parameters;
  switch (s.regime.drive) {
    case Drive::kRegulated:
      return model.mechanics.proportional_gain_V_per_A * (s.held.set_point_A - z[kCurrent]) +
             z[kIntegral];
    case Drive::kLimited:
    case Drive::kVoltage:
    case Drive::kFreewheel:
      return electrical_input(s);
    case Drive::kCurrentLimited:
    case Drive::kOpen:
      break;
  }
  return axis.winding.resistance_ohm * z[kCurrent] + axis.torque_constant_Nm_per_A * z[kMotorSpeed];
}

// Friction that holds a body at rest: all of its load, or what its elastic contact has taken up.
double motor_grip_Nm(const AxisModel& model, const Situation& s, const StateVector& z) noexcept {
  const ElasticContact& contact = model.motor_contact;
  return contact.present() ? contact.stiffness * motor_bend_rad(s, z, 1.0) +
                                 s.terms.extra_motor_grip_Nm + contact.damping * z[kMotorSpeed]
                           : motor_load_Nm(model, s, z, 1.0);
}

double carriage_grip_N(const AxisModel& model, const Situation& s, const StateVector& z) noexcept {
  const ElasticContact& contact = model.carriage_contact;
  return contact.present() ? contact.stiffness * carriage_bend_m(model, s, z, 1.0) +
                                 s.terms.extra_carriage_grip_N + contact.damping * z[kCarriageSpeed]
                           : carriage_load_N(model, s, z, 1.0);
}

// The situation as it is at the end of the step, not in the middle of the last piece.
Situation situation_now(const AxisModel& model, const Situation& s, const StateVector& z) noexcept {
  Situation now = s;
  if (model.has_terms) {
    hold_terms(model, now, motion_at(model, z));
  } else {
    const double x = carriage_position_m(model, z);
    now.motor_friction_Nm = motor_level_Nm(model, z[kMotorSpeed], x, now.position_interval);
    now.carriage_friction_N = carriage_level_N(model, z[kCarriageSpeed], x, now.position_interval);
  }
  return now;
}

}  // namespace

AxisForces AxisPlant::forces() const noexcept {
  const AxisModel& model = *model_;
  const Situation s = situation_now(model, situation_, z_);
  const Regime& regime = s.regime;
  const DerivedMechanics& m = model.mechanics;
  AxisForces f;
  f.terminal_V = terminal_V(model, s, z_);
  f.motor_torque_Nm = model.parameters.torque_constant_Nm_per_A * z_[kCurrent];
  f.ripple_torque_Nm = s.terms.motor_Nm;
  f.motor_sticks = regime.motor_direction == 0;
  f.motor_friction_Nm = (f.motor_sticks ? -motor_grip_Nm(model, s, z_)
                                        : -regime.motor_direction * s.motor_friction_Nm) -
                        m.motor_viscous_Nm_s_per_rad * z_[kMotorSpeed];
  f.external_force_N = input_.carriage_force_N;
  if (regime.end == HardEnd::kPushing) {
    f.end_force_N = -regime.end_sign * end_push_N(model, z_, 1.0, regime.end_sign);
  }
  f.standing_force_N = outside_force_N(model, s, z_, 1.0) - f.end_force_N - f.external_force_N;
  f.voltage_limited = regime.drive == Drive::kLimited;
  if (model.parameters.elasticity.rigid) {
    f.carriage_sticks = f.motor_sticks;
    return f;
  }
  f.transmission_force_N = transmission_force_N(model, s, z_, 1.0);
  f.carriage_sticks = regime.carriage_direction == 0;
  f.carriage_friction_N = (f.carriage_sticks ? -carriage_grip_N(model, s, z_)
                                             : -regime.carriage_direction * s.carriage_friction_N) -
                          m.carriage_viscous_N_s_per_m * z_[kCarriageSpeed];
  return f;
}

}  // namespace towbench::emulator
