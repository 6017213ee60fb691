#include "emulator/plant/axis_model.h"

#include "core/check.h"

namespace towbench::emulator {
namespace {

struct ModeBuilder {
  const AxisParameters& axis;
  const DerivedMechanics& mechanics;
  TransmissionContact transmission;
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

  // gain * F_transmission into a speed row.
  void transmission_force(StateIndex row, double gain) noexcept {
    const TransmissionLaw law = transmission_law(mechanics, {}, transmission, 0.0);
    const double damping = law.damping_N_s_per_m;
    add(row, kStretch, gain * law.stiffness_N_per_m);
    add(row, kMotorSpeed, gain * damping * mechanics.metres_per_motor_rad);
    add(row, kCarriageSpeed, -gain * damping);
  }

  // gain * F_end into a speed row; the constant K_e x_end is part of the held force.
  void end_force(StateIndex row, double gain) noexcept {
    const double stiffness = axis.hard_ends.stiffness_N_per_m;
    add(row, kMotorAngle, -gain * stiffness * mechanics.metres_per_motor_rad);
    add(row, kStretch, gain * stiffness);
    add(row, kCarriageSpeed, -gain * axis.hard_ends.damping_N_s_per_m);
  }

  // gain * F_cable into a speed row; the constant K_w x_w is part of the held force.
  void cable_force(StateIndex row, double gain) noexcept {
    const double stiffness = axis.disturbances.cable.stiffness_N_per_m;
    add(row, kMotorAngle, -gain * stiffness * mechanics.metres_per_motor_rad);
    add(row, kStretch, gain * stiffness);
  }

  // The contact of a motor at rest; sigma_0 theta_0 is part of the held torque.
  void motor_contact(const ElasticContact& contact) noexcept {
    const double mobility = 1.0 / mechanics.motor_inertia_kg_m2;
    add(kMotorSpeed, kMotorAngle, -contact.stiffness * mobility);
    add(kMotorSpeed, kMotorSpeed, -contact.damping * mobility);
  }

  void carriage_contact(const ElasticContact& contact) noexcept {
    const double mobility = 1.0 / mechanics.carriage_mass_kg;
    add(kCarriageSpeed, kMotorAngle,
        -contact.stiffness * mobility * mechanics.metres_per_motor_rad);
    add(kCarriageSpeed, kStretch, contact.stiffness * mobility);
    add(kCarriageSpeed, kCarriageSpeed, -contact.damping * mobility);
  }

  void motor() noexcept {
    const double mobility = 1.0 / mechanics.motor_inertia_kg_m2;
    add(kMotorSpeed, kCurrent, axis.torque_constant_Nm_per_A * mobility);
    add(kMotorSpeed, kMotorSpeed, -mechanics.motor_viscous_Nm_s_per_rad * mobility);
    add(kMotorSpeed, kMotorTorque, mobility);
    add(kMotorAngle, kMotorSpeed, 1.0);
    if (!axis.elasticity.rigid) {
      transmission_force(kMotorSpeed, -mechanics.metres_per_motor_rad * mobility);
    }
  }

  void carriage(bool end_pushes) noexcept {
    const double mobility = 1.0 / mechanics.carriage_mass_kg;
    add(kCarriageSpeed, kCarriageSpeed, -mechanics.carriage_viscous_N_s_per_m * mobility);
    add(kCarriageSpeed, kCarriageForce, mobility);
    transmission_force(kCarriageSpeed, mobility);
    if (end_pushes) {
      end_force(kCarriageSpeed, mobility);
    }
    cable_force(kCarriageSpeed, mobility);
  }

  // The carriage follows the motor: its force joins the motor's row, and its speed row is r times
  // the motor's.
  void rigid_carriage(bool end_pushes) noexcept {
    const double r = mechanics.metres_per_motor_rad;
    const double mobility = 1.0 / mechanics.motor_inertia_kg_m2;
    add(kMotorSpeed, kCarriageForce, r * mobility);
    if (end_pushes) {
      end_force(kMotorSpeed, r * mobility);
    }
    cable_force(kMotorSpeed, r * mobility);
    for (auto& column : mode.state) {
      column[kCarriageSpeed] = r * column[kMotorSpeed];
    }
    for (auto& column : mode.input) {
      column[kCarriageSpeed] = r * column[kMotorSpeed];
    }
  }
};

TransmissionContact contact_of(TransmissionPull pull) noexcept {
  switch (pull) {
    case TransmissionPull::kBothStrands:
      return TransmissionContact::kTaut;
    case TransmissionPull::kOneStrand:
      return TransmissionContact::kOneStrand;
    case TransmissionPull::kNone:
      break;
  }
  return TransmissionContact::kOpen;
}

// A friction that differs by direction needs to know the direction.
bool skews_viscous(const AxisParameters& axis) noexcept {
  return axis.friction.options.asymmetry.viscous != 0;
}

// What the fast path of a nominal axis does not know.
bool any_term(const AxisModel& model) noexcept {
  const AxisParameters& p = model.parameters;
  return p.disturbances.any_held() || p.friction.options.any_held() || model.play.present() ||
         model.gear_loss.present() || model.motor_contact.present() ||
         model.carriage_contact.present();
}

}  // namespace

ContinuousMode continuous_mode(const AxisParameters& axis, const DerivedMechanics& mechanics,
                               const ModeKey& key) noexcept {
  ModeBuilder builder{axis, mechanics, contact_of(key.pull), {}};
  const ElasticContact at_motor = motor_contact(axis, mechanics);
  const ElasticContact at_carriage = carriage_contact(axis, mechanics);
  const bool motor_moves = key.motor_moves || at_motor.present();
  builder.winding(key.winding);
  if (motor_moves) {
    builder.motor();
  }
  if (!key.motor_moves && at_motor.present()) {
    builder.motor_contact(at_motor);
  }
  if (axis.elasticity.rigid) {
    if (motor_moves) {
      builder.rigid_carriage(key.end_pushes);
    }
    return builder.mode;
  }
  builder.add(kStretch, kMotorSpeed, mechanics.metres_per_motor_rad);
  builder.add(kStretch, kCarriageSpeed, -1.0);
  if (key.carriage_moves || at_carriage.present()) {
    builder.carriage(key.end_pushes);
  }
  if (!key.carriage_moves && at_carriage.present()) {
    builder.carriage_contact(at_carriage);
  }
  return builder.mode;
}

ElasticContact motor_contact(const AxisParameters& axis,
                             const DerivedMechanics& mechanics) noexcept {
  const Presliding& p = axis.friction.options.presliding;
  return elastic_contact(mechanics.motor, p.travel_rad, p.damping_ratio,
                         mechanics.motor_inertia_kg_m2);
}

ElasticContact carriage_contact(const AxisParameters& axis,
                                const DerivedMechanics& mechanics) noexcept {
  const Presliding& p = axis.friction.options.presliding;
  return elastic_contact(mechanics.carriage, p.travel_rad * mechanics.metres_per_motor_rad,
                         p.damping_ratio, mechanics.carriage_mass_kg);
}

std::size_t modes_in_use(const TransmissionPlay& play) noexcept {
  return play.present() ? kModeCount : kModesPerPull;
}

AxisModel::AxisModel(const AxisParameters& axis, double tick_length_s) noexcept
    : parameters(axis),
      mechanics(derive(axis)),
      stribeck(axis.friction.stribeck_form),
      position_friction(axis.friction.position.position_m, axis.friction.position.friction_Nm,
                        axis.elasticity.rigid ? 1.0 : 1.0 / mechanics.metres_per_motor_rad),
      position_force(axis.disturbances.position_force.position_m,
                     axis.disturbances.position_force.torque_Nm,
                     1.0 / mechanics.metres_per_motor_rad),
      ripple(axis.disturbances.torque_ripple),
      wheel(axis),
      gear_loss(axis.gear.efficiency),
      play(transmission_play(axis, mechanics)),
      motor_contact(emulator::motor_contact(axis, mechanics)),
      carriage_contact(emulator::carriage_contact(axis, mechanics)),
      tick_s(tick_length_s),
      motor_is_dry(mechanics.motor.present() || gear_loss.present() || skews_viscous(axis) ||
                   (axis.elasticity.rigid && position_friction.present())),
      carriage_is_dry(!axis.elasticity.rigid &&
                      (mechanics.carriage.present() || position_friction.present() ||
                       skews_viscous(axis) || axis.friction.options.load_ratio != 0)),
      has_terms(any_term(*this)) {
  for (std::size_t index = 0; index < modes_in_use(play); ++index) {
    flows[index] = continuous_mode(axis, mechanics, ModeKey::of_index(index));
    core::check(discretise(flows[index], tick_s, ticks[index]));
  }
}

}  // namespace towbench::emulator
