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

}  // namespace

AxisForces AxisPlant::forces() const noexcept {
  const AxisModel& model = *model_;
  const Regime& regime = situation_.regime;
  const DerivedMechanics& m = model.mechanics;
  const double x = carriage_position_m(model, z_);
  std::size_t interval = situation_.position_interval;
  AxisForces f;
  f.terminal_V = terminal_V(model, situation_, z_);
  f.motor_torque_Nm = model.parameters.torque_constant_Nm_per_A * z_[kCurrent];
  f.motor_sticks = regime.motor_direction == 0;
  f.motor_friction_Nm =
      f.motor_sticks
          ? -motor_load_Nm(model, situation_, z_, 1.0)
          : -regime.motor_direction * motor_level_Nm(model, z_[kMotorSpeed], x, interval) -
                m.motor_viscous_Nm_s_per_rad * z_[kMotorSpeed];
  f.external_force_N = situation_.held.carriage_force_N;
  if (regime.end == HardEnd::kPushing) {
    f.end_force_N = -regime.end_sign * end_push_N(model, z_, 1.0, regime.end_sign);
  }
  f.voltage_limited = regime.drive == Drive::kLimited;
  if (model.parameters.chain.rigid) {
    f.carriage_sticks = f.motor_sticks;
    return f;
  }
  f.chain_force_N = chain_force_N(model, z_);
  f.carriage_sticks = regime.carriage_direction == 0;
  f.carriage_friction_N =
      f.carriage_sticks
          ? -carriage_load_N(model, situation_, z_, 1.0)
          : -regime.carriage_direction * carriage_level_N(model, z_[kCarriageSpeed], x, interval) -
                m.carriage_viscous_N_s_per_m * z_[kCarriageSpeed];
  return f;
}

}  // namespace towbench::emulator
