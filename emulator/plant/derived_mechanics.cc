#include "emulator/plant/derived_mechanics.h"

#include <numbers>

#include "core/deterministic_math.h"

namespace towbench::emulator {
namespace {

// `radius` turns a torque at the motor into a force on the body, and a speed likewise.
DryFriction dry_friction(const AxisParameters& p, double share, double radius) noexcept {
  const double coulomb = share * p.coulomb_friction_Nm / radius;
  const double breakaway = share * p.friction.breakaway_Nm / radius;
  return {.coulomb = coulomb,
          .breakaway = breakaway,
          .excess = breakaway - coulomb,
          .inverse_speed = 1.0 / (p.friction.stribeck_speed_rad_per_s * radius)};
}

void share_out(const AxisParameters& p, DerivedMechanics& d) noexcept {
  const double r = d.metres_per_motor_rad;
  const double on_carriage = p.elasticity.rigid ? 0.0 : p.friction.carriage_share;
  const double on_motor = 1.0 - on_carriage;
  d.motor_viscous_Nm_s_per_rad = on_motor * p.viscous_friction_Nm_s_per_rad;
  d.carriage_viscous_N_s_per_m = on_carriage * p.viscous_friction_Nm_s_per_rad / (r * r);
  d.motor = dry_friction(p, on_motor, 1.0);
  d.carriage = dry_friction(p, on_carriage, r);
}

void derive_transmission(const AxisParameters& p, DerivedMechanics& d) noexcept {
  const double r = d.metres_per_motor_rad;
  const double resonance_rad_per_s = 2.0 * std::numbers::pi * p.elasticity.resonance_Hz;
  const double mobility = r * r / d.motor_inertia_kg_m2 + 1.0 / d.carriage_mass_kg;
  d.transmission_stiffness_N_per_m = resonance_rad_per_s * resonance_rad_per_s / mobility;
  d.transmission_damping_N_s_per_m =
      2.0 * p.elasticity.damping_ratio * resonance_rad_per_s / mobility;
}

// The zero of the PI cancels the winding's pole: C(s) = w_c (L s + R) / s leaves the loop w_c / s,
// whose closed form has exactly the bandwidth w_c.
void derive_current_loop(const AxisParameters& p, DerivedMechanics& d) noexcept {
  const double corner_rad_per_s = 2.0 * std::numbers::pi * p.amplifier.current_loop_bandwidth_Hz;
  d.proportional_gain_V_per_A =
      corner_rad_per_s * (p.winding.inductance_H + p.winding.choke_inductance_H);
  d.integral_gain_V_per_A_s = corner_rad_per_s * p.winding.resistance_ohm;
}

}  // namespace

DerivedMechanics derive(const AxisParameters& p) noexcept {
  DerivedMechanics d;
  const double r = p.output_radius_m / p.gear_ratio;
  d.metres_per_motor_rad = r;
  d.motor_inertia_kg_m2 = p.elasticity.rigid ? p.inertia_kg_m2 : p.rotor_inertia_kg_m2;
  d.carriage_mass_kg = (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) / (r * r);
  share_out(p, d);
  if (!p.elasticity.rigid) {
    derive_transmission(p, d);
  }
  constexpr double kGravity_m_per_s2 = 9.80665;
  d.tilt_force_N = -d.carriage_mass_kg * kGravity_m_per_s2 *
                   core::sine_cosine_of_turns(p.disturbances.tilt_deg / 360.0).sine;
  // The spring was found without water: its mode gets slower with it, the spring no softer.
  d.carriage_mass_kg += p.water_mass_kg;
  d.motor_inertia_kg_m2 += p.elasticity.rigid ? p.water_mass_kg * r * r : 0.0;
  derive_current_loop(p, d);
  return d;
}

}  // namespace towbench::emulator
