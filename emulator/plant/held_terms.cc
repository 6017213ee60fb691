#include "emulator/plant/held_terms.h"

#include <numbers>

#include "core/deterministic_math.h"

namespace towbench::emulator {
namespace {

// Coulomb, break-away and Stribeck part in one direction, skewed and warmed; viscous skew on top.
double skewed_level(const AxisModel& model, const DryFriction& law, double viscous, double scale,
                    double direction, double speed) noexcept {
  const FrictionAsymmetry& share = model.parameters.friction.options.asymmetry;
  const double coulomb = law.coulomb * (1.0 + direction * share.coulomb);
  const double breakaway = law.breakaway * (1.0 + direction * share.breakaway);
  const double fade = model.stribeck(std::fabs(speed) * law.inverse_speed);
  return scale * (coulomb + (breakaway - coulomb) * fade) +
         direction * share.viscous * viscous * std::fabs(speed);
}

double motor_level(const AxisModel& model, Situation& s, double direction, double speed,
                   double carriage_m) noexcept {
  const double level =
      skewed_level(model, model.mechanics.motor, model.mechanics.motor_viscous_Nm_s_per_rad,
                   s.terms.level_scale, direction, speed);
  return model.parameters.elasticity.rigid
             ? level + model.position_friction(carriage_m, s.position_interval)
             : level;
}

double carriage_level(const AxisModel& model, Situation& s, double direction, double speed,
                      double carriage_m) noexcept {
  return skewed_level(model, model.mechanics.carriage, model.mechanics.carriage_viscous_N_s_per_m,
                      s.terms.level_scale, direction, speed) +
         model.position_friction(carriage_m, s.position_interval);
}

double carriage_load_factor(const AxisModel& model, double transmission_N) noexcept {
  const double ratio = model.parameters.friction.options.load_ratio;
  return transmission_N < 0 ? -ratio : ratio;
}

void hold_transmission(const AxisModel& model, Situation& s,
                       const MiddleOfMotion& middle) noexcept {
  const double r = model.mechanics.metres_per_motor_rad;
  HeldTerms& t = s.terms;
  Wheel::Excess excess;
  if (model.wheel.present()) {
    excess = model.wheel(model.sine, middle.motor_rad);
    t.wheel_slope_m_per_rad = excess.slope_m_per_rad;
    t.wheel_offset_m = excess.offset_m - excess.slope_m_per_rad * middle.motor_rad;
  }
  t.extra_transmission_N =
      s.transmission.stiffness_N_per_m * excess.offset_m +
      s.transmission.damping_N_s_per_m * excess.slope_m_per_rad * middle.motor_rad_per_s +
      s.transmission.constant_N;
  t.transmission_N =
      s.transmission.stiffness_N_per_m * (r * middle.motor_rad - middle.carriage_m) +
      s.transmission.damping_N_s_per_m * (r * middle.motor_rad_per_s - middle.carriage_m_per_s) +
      t.extra_transmission_N;
}

// Of a load that turns: its position is an angle.
double weight_Nm(const GravityParameters& gravity, double load_rad) noexcept {
  constexpr double kTurnsPerRad = 0.5 / std::numbers::pi;
  const double turns = load_rad * kTurnsPerRad + gravity.zero_at_deg / 360.0;
  return -gravity.torque_Nm * core::sine_cosine_of_turns(turns).sine;
}

// What break-away takes on the side to which a contact is bent.
double level_at_bend(const BreakAway& level, double bend, double transmission_N) noexcept {
  return breakaway_margin(level, bend < 0 ? -1.0 : 1.0, 0.0, transmission_N, 1.0);
}

double extra_grip(const ElasticContact& contact, const BreakAway& level, double bend,
                  double transmission_N) noexcept {
  return (level_at_bend(level, bend, transmission_N) - contact.breakaway) * bend / contact.travel;
}

}  // namespace

void hold_terms(const AxisModel& model, Situation& s, const MiddleOfMotion& middle) noexcept {
  hold_transmission(model, s, middle);
  HeldTerms& t = s.terms;
  if (model.ripple.present()) {
    t.motor_Nm = model.ripple.mean(model.sine, middle.motor_rad, middle.travel_rad);
  }
  t.carriage_N = model.position_force.present()
                     ? model.position_force(middle.carriage_m, s.force_interval)
                     : 0.0;
  if (const GravityParameters& gravity = model.parameters.disturbances.gravity;
      gravity.torque_Nm != 0) {
    t.carriage_N += weight_Nm(gravity, middle.carriage_m);
  }
  const double along = s.regime.motor_direction;
  if (model.motor_is_dry && along != 0) {
    s.motor_friction_Nm =
        motor_level(model, s, along, middle.motor_rad_per_s, middle.carriage_m) +
        model.gear_loss.factor(transmission_lever_m(model, s), along, t.transmission_N) *
            t.transmission_N;
  } else if (model.motor_is_dry) {
    hold_motor_breakaway(model, s, middle.carriage_m);
    if (model.motor_contact.present()) {
      t.extra_motor_grip_Nm = extra_grip(model.motor_contact, s.motor_breakaway,
                                         middle.motor_rad - s.motor_anchor_rad, t.transmission_N);
    }
  }
  const double forth = s.regime.carriage_direction;
  if (model.carriage_is_dry && forth != 0) {
    s.carriage_friction_N =
        carriage_level(model, s, forth, middle.carriage_m_per_s, middle.carriage_m) +
        carriage_load_factor(model, t.transmission_N) * t.transmission_N;
  } else if (model.carriage_is_dry) {
    hold_carriage_breakaway(model, s, middle.carriage_m);
    if (model.carriage_contact.present()) {
      t.extra_carriage_grip_N =
          extra_grip(model.carriage_contact, s.carriage_breakaway,
                     middle.carriage_m - s.carriage_anchor_m, t.transmission_N);
    }
  }
}

void hold_motor_breakaway(const AxisModel& model, Situation& s, double carriage_m) noexcept {
  const double lever = transmission_lever_m(model, s);
  s.motor_breakaway = {
      .towards_max = motor_level(model, s, 1.0, 0.0, carriage_m),
      .towards_min = motor_level(model, s, -1.0, 0.0, carriage_m),
      .towards_max_per_transmission_N = model.gear_loss.factor(lever, 1.0, s.terms.transmission_N),
      .towards_min_per_transmission_N =
          model.gear_loss.factor(lever, -1.0, s.terms.transmission_N)};
}

void hold_carriage_breakaway(const AxisModel& model, Situation& s, double carriage_m) noexcept {
  const double factor = carriage_load_factor(model, s.terms.transmission_N);
  s.carriage_breakaway = {.towards_max = carriage_level(model, s, 1.0, 0.0, carriage_m),
                          .towards_min = carriage_level(model, s, -1.0, 0.0, carriage_m),
                          .towards_max_per_transmission_N = factor,
                          .towards_min_per_transmission_N = factor};
}

}  // namespace towbench::emulator
