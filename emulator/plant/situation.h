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

// Level at which a body at rest breaks away, by direction: constant + per_transmission *
// F_transmission. N m or N.
struct BreakAway {
  double towards_max = 0;
  double towards_min = 0;
  double towards_max_per_transmission_N = 0;
  double towards_min_per_transmission_N = 0;
};

// What the optional laws add (held_terms.h); all zero without them.
struct HeldTerms {
  double motor_Nm = 0;        // + towards max
  double carriage_N = 0;      // likewise
  double wheel_offset_m = 0;  // the wheel's excess, offset + slope theta around the middle
  double wheel_slope_m_per_rad = 0;
  double transmission_N = 0;        // transmission force in the middle
  double extra_transmission_N = 0;  // the part of it that the linear mode does not have
  double extra_motor_grip_Nm = 0;   // of the elastic contacts, likewise
  double extra_carriage_grip_N = 0;
  double level_scale = 1;  // of dry friction, falls with warmth
};

struct Situation {
  Regime regime;
  HeldInput held;
  // Dry friction that brakes a moving body, absolute. N m and N.
  double motor_friction_Nm = 0;
  double carriage_friction_N = 0;
  BreakAway motor_breakaway;
  BreakAway carriage_breakaway;
  double motor_anchor_rad = 0;  // where a resting body's elastic contact is relaxed
  double carriage_anchor_m = 0;
  TransmissionLaw transmission;  // the regime's
  HeldTerms terms;
  std::size_t position_interval = 0;  // of the position friction, where the carriage was last
  std::size_t force_interval = 0;     // of the position force, likewise
};

[[nodiscard]] inline double carriage_position_m(const AxisModel& model,
                                                const StateVector& z) noexcept {
  return model.mechanics.metres_per_motor_rad * z[kMotorAngle] - z[kStretch];
}

// What the transmission is stretched by, wheel and all. `one` is 1, or 0 for the linear part alone.
[[nodiscard]] inline double transmission_stretch_m(const Situation& s, const StateVector& z,
                                                   double one) noexcept {
  return z[kStretch] +
         (one * s.terms.wheel_offset_m + s.terms.wheel_slope_m_per_rad * z[kMotorAngle]);
}

[[nodiscard]] inline double transmission_lever_m(const AxisModel& model,
                                                 const Situation& s) noexcept {
  return model.mechanics.metres_per_motor_rad + s.terms.wheel_slope_m_per_rad;
}

// Of a given law, which may be another than the regime's.
[[nodiscard]] inline double transmission_force_N(const AxisModel& model, const TransmissionLaw& law,
                                                 const Situation& s, const StateVector& z,
                                                 double one) noexcept {
  return law.stiffness_N_per_m * transmission_stretch_m(s, z, one) +
         law.damping_N_s_per_m *
             (transmission_lever_m(model, s) * z[kMotorSpeed] - z[kCarriageSpeed]) +
         one * law.constant_N;
}

[[nodiscard]] inline double transmission_force_N(const AxisModel& model, const Situation& s,
                                                 const StateVector& z, double one) noexcept {
  return transmission_force_N(model, s.transmission, s, z, one);
}

// Penetration, + when beyond the stop that `sign` names. `one` as above.
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

// Everything on the carriage but its own friction and transmission, N; `one` as above.
[[nodiscard]] inline double outside_force_N(const AxisModel& model, const Situation& s,
                                            const StateVector& z, double one) noexcept {
  double force = one * (s.held.carriage_force_N + s.terms.carriage_N);
  if (const double k = model.parameters.disturbances.cable.stiffness_N_per_m; k != 0) {
    force -= k * carriage_position_m(model, z);
  }
  if (s.regime.end == HardEnd::kPushing) {
    force -= s.regime.end_sign * end_push_N(model, z, one, s.regime.end_sign);
  }
  return force;
}

// What friction must hold for the motor to stay at rest, N m.
[[nodiscard]] inline double motor_load_Nm(const AxisModel& model, const Situation& s,
                                          const StateVector& z, double one) noexcept {
  const double on_wheel_N = model.parameters.elasticity.rigid
                                ? outside_force_N(model, s, z, one)
                                : -transmission_force_N(model, s, z, one);
  return model.parameters.torque_constant_Nm_per_A * z[kCurrent] + one * s.terms.motor_Nm +
         transmission_lever_m(model, s) * on_wheel_N;
}

// What friction must hold for the carriage to stay at rest, N. Elastic transmission only.
[[nodiscard]] inline double carriage_load_N(const AxisModel& model, const Situation& s,
                                            const StateVector& z, double one) noexcept {
  return transmission_force_N(model, s, z, one) + outside_force_N(model, s, z, one);
}

// How far a resting body's elastic contact is bent.
[[nodiscard]] inline double motor_bend_rad(const Situation& s, const StateVector& z,
                                           double one) noexcept {
  return z[kMotorAngle] - one * s.motor_anchor_rad;
}
[[nodiscard]] inline double carriage_bend_m(const AxisModel& model, const Situation& s,
                                            const StateVector& z, double one) noexcept {
  return carriage_position_m(model, z) - one * s.carriage_anchor_m;
}

// How much more than `load` it would take to break away in the direction `sign`.
[[nodiscard]] inline double breakaway_margin(const BreakAway& level, double sign, double load,
                                             double transmission_N, double one) noexcept {
  return sign > 0 ? one * level.towards_max +
                        level.towards_max_per_transmission_N * transmission_N - load
                  : one * level.towards_min +
                        level.towards_min_per_transmission_N * transmission_N + load;
}

// (3.34) without sign and viscous part.
[[nodiscard]] inline double friction_level(const AxisModel& model, const DryFriction& law,
                                           double speed) noexcept {
  return law.coulomb + law.excess * model.stribeck(std::fabs(speed) * law.inverse_speed);
}

[[nodiscard]] inline double motor_level_Nm(const AxisModel& model, double speed_rad_per_s,
                                           double carriage_m, std::size_t& interval) noexcept {
  const double level = friction_level(model, model.mechanics.motor, speed_rad_per_s);
  return model.parameters.elasticity.rigid ? level + model.position_friction(carriage_m, interval)
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
  double torque = -s.regime.motor_direction * s.motor_friction_Nm;
  if (s.regime.end == HardEnd::kPushing) {
    const auto& ends = model.parameters.hard_ends;
    force += ends.stiffness_N_per_m * (s.regime.end_sign > 0 ? ends.max_m : ends.min_m);
  }
  if (model.has_terms) {
    const HeldTerms& t = s.terms;
    force += t.carriage_N + t.extra_transmission_N;
    torque += t.motor_Nm - model.mechanics.metres_per_motor_rad * t.extra_transmission_N -
              t.wheel_slope_m_per_rad * t.transmission_N;
    if (s.regime.motor_direction == 0) {
      torque += model.motor_contact.stiffness * s.motor_anchor_rad - t.extra_motor_grip_Nm;
    }
    if (s.regime.carriage_direction == 0) {
      force += model.carriage_contact.stiffness * s.carriage_anchor_m - t.extra_carriage_grip_N;
    }
  }
  return {electrical_input(s), torque, force};
}

}  // namespace towbench::emulator
