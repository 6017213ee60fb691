#include "emulator/plant/axis_model.h"

#include "core/check.h"

namespace towbench::emulator {
namespace {

struct ModeBuilder {
  const AxisParameters& axis;
  const DerivedMechanics& mechanics;
  ContinuousMode mode;

  // d z[row] / dt += value * z[column]
  void add(StateIndex row, StateIndex column, double value) noexcept {
    mode.state[column][row] += value;
  }
  void add(StateIndex row, InputIndex column, double value) noexcept {
    mode.input[column][row] += value;
  }

  void winding(Winding how) noexcept {
    if (how == Winding::kFixedCurrent) {
      return;
    }
    const double inductance = axis.winding.inductance_H + axis.winding.choke_inductance_H;
    const double reset_rate_per_s =
        mechanics.integral_gain_V_per_A_s / mechanics.proportional_gain_V_per_A;
    add(kCurrent, kCurrent, -axis.winding.resistance_ohm / inductance);
    add(kCurrent, kMotorSpeed, -axis.torque_constant_Nm_per_A / inductance);
    if (how != Winding::kCurrentLoop) {
      add(kCurrent, kElectricalInput, 1.0 / inductance);
      if (how == Winding::kLimitedLoop) {
        add(kIntegral, kElectricalInput, reset_rate_per_s);
        add(kIntegral, kIntegral, -reset_rate_per_s);
      }
      return;
    }
    add(kCurrent, kCurrent, -mechanics.proportional_gain_V_per_A / inductance);
    add(kCurrent, kElectricalInput, mechanics.proportional_gain_V_per_A / inductance);
    add(kCurrent, kIntegral, 1.0 / inductance);
    add(kIntegral, kCurrent, -mechanics.integral_gain_V_per_A_s);
    add(kIntegral, kElectricalInput, mechanics.integral_gain_V_per_A_s);
  }

  // gain * F_chain into a speed row.
  void chain_force(StateIndex row, double gain) noexcept {
    const double damping = mechanics.chain_damping_N_s_per_m;
    add(row, kStretch, gain * mechanics.chain_stiffness_N_per_m);
    add(row, kMotorSpeed, gain * damping * mechanics.metres_per_radian);
    add(row, kCarriageSpeed, -gain * damping);
  }

  // gain * F_end into a speed row; the constant K_e x_end is part of the held force.
  void end_force(StateIndex row, double gain) noexcept {
    const double stiffness = axis.hard_ends.stiffness_N_per_m;
    add(row, kMotorAngle, -gain * stiffness * mechanics.metres_per_radian);
    add(row, kStretch, gain * stiffness);
    add(row, kCarriageSpeed, -gain * axis.hard_ends.damping_N_s_per_m);
  }

  void motor() noexcept {
    const double mobility = 1.0 / mechanics.motor_inertia_kg_m2;
    add(kMotorSpeed, kCurrent, axis.torque_constant_Nm_per_A * mobility);
    add(kMotorSpeed, kMotorSpeed, -mechanics.motor_viscous_Nm_s_per_rad * mobility);
    add(kMotorSpeed, kMotorTorque, mobility);
    add(kMotorAngle, kMotorSpeed, 1.0);
    if (!axis.chain.rigid) {
      chain_force(kMotorSpeed, -mechanics.metres_per_radian * mobility);
    }
  }

  void carriage(bool end_pushes) noexcept {
    const double mobility = 1.0 / mechanics.carriage_mass_kg;
    add(kCarriageSpeed, kCarriageSpeed, -mechanics.carriage_viscous_N_s_per_m * mobility);
    add(kCarriageSpeed, kCarriageForce, mobility);
    chain_force(kCarriageSpeed, mobility);
    if (end_pushes) {
      end_force(kCarriageSpeed, mobility);
    }
  }

  // The carriage follows the motor: its force joins the motor's row, and its speed row is r times
  // the motor's.
  void rigid_carriage(bool end_pushes) noexcept {
    const double r = mechanics.metres_per_radian;
    const double mobility = 1.0 / mechanics.motor_inertia_kg_m2;
    add(kMotorSpeed, kCarriageForce, r * mobility);
    if (end_pushes) {
      end_force(kMotorSpeed, r * mobility);
    }
    for (auto& column : mode.state) {
      column[kCarriageSpeed] = r * column[kMotorSpeed];
    }
    for (auto& column : mode.input) {
      column[kCarriageSpeed] = r * column[kMotorSpeed];
    }
  }
};

}  // namespace

ContinuousMode continuous_mode(const AxisParameters& axis, const DerivedMechanics& mechanics,
                               const ModeKey& key) noexcept {
  ModeBuilder builder{axis, mechanics, {}};
  builder.winding(key.winding);
  if (key.motor_moves) {
    builder.motor();
  }
  if (axis.chain.rigid) {
    if (key.motor_moves) {
      builder.rigid_carriage(key.end_pushes);
    }
    return builder.mode;
  }
  builder.add(kStretch, kMotorSpeed, mechanics.metres_per_radian);
  builder.add(kStretch, kCarriageSpeed, -1.0);
  if (key.carriage_moves) {
    builder.carriage(key.end_pushes);
  }
  return builder.mode;
}

AxisModel::AxisModel(const AxisParameters& axis, double tick_length_s) noexcept
    : parameters(axis),
      mechanics(derive(axis)),
      stribeck(axis.friction.stribeck_form),
      position_friction(axis.friction.position,
                        axis.chain.rigid ? 1.0 : 1.0 / mechanics.metres_per_radian),
      tick_s(tick_length_s),
      motor_is_dry(mechanics.motor.present() || (axis.chain.rigid && position_friction.present())),
      carriage_is_dry(!axis.chain.rigid &&
                      (mechanics.carriage.present() || position_friction.present())) {
  for (std::size_t index = 0; index < kModeCount; ++index) {
    flows[index] = continuous_mode(axis, mechanics, ModeKey::of_index(index));
    core::check(discretise(flows[index], tick_s, ticks[index]));
  }
}

}  // namespace towbench::emulator
