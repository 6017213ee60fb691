#include "study/procedures/believed_model.h"

#include <algorithm>
#include <cmath>

#include "study/procedures/procedures.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {

emulator::AxisParameters believed_axis(const ProcedureContext& context) {
  const auto& plate = context.machine.nameplate(context.axis);
  const auto& belief = context.machine.configuration().axes[context.axis];
  emulator::AxisParameters axis;
  axis.gear_ratio = plate.gear_ratio;
  axis.output_radius_m = plate.output_radius_m;
  axis.rotor_inertia_kg_m2 = plate.rotor_inertia_kg_m2;
  axis.winding = {.resistance_ohm = plate.resistance_ohm,
                  .inductance_H = plate.inductance_H,
                  .choke_inductance_H = 0};
  axis.amplifier.current_loop_bandwidth_Hz = plate.current_loop_bandwidth_Hz;
  axis.current_limit_A = plate.current_limit_A;
  axis.hard_ends.fitted = false;
  axis.torque_constant_Nm_per_A =
      value_or(context, "torque_constant_Nm_per_A", belief.drive.torque_constant_Nm_per_A);
  axis.amplifier_gain_A_per_V =
      value_or(context, "amplifier_gain_A_per_V", belief.drive.amplifier_gain_A_per_V);
  const auto& model = belief.feed_forward;
  axis.inertia_kg_m2 = std::max(value_or(context, "inertia_kg_m2", model.inertia_kg_m2),
                                1.05 * plate.rotor_inertia_kg_m2);
  axis.viscous_friction_Nm_s_per_rad =
      value_or(context, "viscous_friction_Nm_s_per_rad", model.viscous_friction_Nm_s_per_rad);
  axis.coulomb_friction_Nm = model.coulomb_friction_Nm;
  axis.friction.breakaway_Nm =
      std::max(belief.friction.breakaway_Nm, 1.1 * axis.coulomb_friction_Nm);
  axis.friction.stribeck_speed_rad_per_s = belief.friction.stribeck_speed_rad_per_s;
  // The free-free mode from what the controller believes of the held motor's:
  // w0^2 = K_s (r^2/J_m + 1/M), held: K_s / M.
  const double ratio = (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / axis.rotor_inertia_kg_m2;
  axis.elasticity.resonance_Hz = belief.braking.held_motor_chain_Hz * std::sqrt(1 + ratio);
  return axis;
}

identify::DrivePath believed_path(const ProcedureContext& context) {
  const auto& plate = context.machine.nameplate(context.axis);
  const emulator::AmplifierParameters amplifier;
  return {.pwm_amplitude_V = plate.pwm_amplitude_V,
          .supply_V = plate.output_limit_V / amplifier.output_limit_ratio};
}

namespace {

// The guard of the encoder takes off the drive what the carriage's swing asks of the motor. With a
// transmission that was only believed it takes a motor that is held by the swing for a frozen
// encoder.
void tell_swing(const identify::Estimates& known, core::Axis which,
                bbmc::BrakingConfiguration& braking) {
  const auto of = [&](std::string_view quantity, double otherwise) {
    const auto* found = identify::find(known, quantity, core::name_of(which));
    return found != nullptr ? found->value : otherwise;
  };
  const double coasts_kg_m2 =
      of("mechanical_time_constant_s", 0) * of("steady_viscous_Nm_s_per_rad", 0);
  const double inertia_kg_m2 = of("inertia_kg_m2", coasts_kg_m2);
  const double free_Hz = of("transmission_resonance_Hz", of("swing_Hz", 0));
  if (inertia_kg_m2 > braking.rotor_inertia_kg_m2 && free_Hz > 0) {
    braking.inertia_kg_m2 = inertia_kg_m2;
    braking.held_motor_chain_Hz = free_Hz * std::sqrt(braking.rotor_inertia_kg_m2 / inertia_kg_m2);
  }
}

}  // namespace

bbmc::Configuration studied_configuration(const ProcedureContext& context) {
  constexpr double kMostFriction = 1.6;  // *assumed*: no machine of a kind has more than that
  auto configuration = context.machine.configuration();
  for (const auto which : core::kPlanarAxes) {
    auto& axis = configuration.axes[which];
    const auto of = [&](std::string_view quantity, double& field) {
      if (const auto* found = identify::find(context.known, quantity, core::name_of(which))) {
        field = found->value;
      }
    };
    of("torque_constant_Nm_per_A", axis.drive.torque_constant_Nm_per_A);
    of("amplifier_gain_A_per_V", axis.drive.amplifier_gain_A_per_V);
    axis.plausibility.worst_breakaway_Nm *= kMostFriction;
    tell_swing(context.known, which, axis.braking);
    // With a weaker motor than believed the voltage is used up at a higher speed; the guard against
    // running away shall know of it.
    const auto& plate = context.machine.nameplate(which);
    if (identify::find(context.known, "torque_constant_Nm_per_A", core::name_of(which)) !=
        nullptr) {
      axis.speed_limit_m_per_s = std::max(
          axis.speed_limit_m_per_s, plate.output_limit_V / axis.drive.torque_constant_Nm_per_A *
                                        plate.metres_per_motor_rad());
    }
  }
  return configuration;
}

TorqueScale torque_scale(const ProcedureContext& context) {
  const auto axis = believed_axis(context);
  TorqueScale scale;
  scale.torque_per_duty_Nm = axis.torque_constant_Nm_per_A * axis.amplifier_gain_A_per_V *
                             context.machine.nameplate(context.axis).pwm_amplitude_V / 100;
  if (const auto* measured = context.find("torque_per_volt_Nm_per_V")) {
    scale.measured = true;
    scale.relative_standard_error =
        measured->half_width() / measured->value / statistics::kNormal95;
  }
  return scale;
}

}  // namespace towbench::study::procedures
