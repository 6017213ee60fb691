#include "study/extended_plant/stated_terms.h"

#include <cmath>
#include <numbers>

#include "emulator/plant/derived_mechanics.h"
#include "emulator/water/water.h"

namespace towbench::study::diagnose {
namespace {

using emulator::AxisParameters;

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kGravity_m_per_s2 = 9.80665;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

double metres_per_motor_rad(const AxisParameters& p) {
  return p.output_radius_m / p.gear_ratio;
}

void add_friction(const emulator::FrictionParameters& f, double r, NominalModel& m) {
  m.terms[Key::kCoulombAsymmetry] = f.options.asymmetry.coulomb * m.coulomb_N;
  m.terms[Key::kViscousAsymmetry] = f.options.asymmetry.viscous * m.viscous_N_s_per_m;
  m.terms[Key::kLoadFriction] = f.options.load_ratio;
  const emulator::Presliding& presliding = f.options.presliding;
  if (presliding.travel_rad > 0 && m.coulomb_N > 0) {
    // All of dry friction follows the way.
    const double travel_m = presliding.travel_rad * r;
    const double stiffness_N_per_m = (m.coulomb_N + m.breakaway_excess_N) / travel_m;
    const double damping_N_s_per_m =
        2 * presliding.damping_ratio * std::sqrt(stiffness_N_per_m * m.mass_kg);
    m.terms[Key::kPresliding] = 2 * m.coulomb_N;
    m.terms[Key::kPreslidingTravel] = travel_m;
    m.terms[Key::kPreslidingTime] = damping_N_s_per_m * travel_m / (kPrandtlDamping * m.coulomb_N);
  }
}

// Where a joint is at rest, and what pushes a carriage.
void add_forces_by_place(const AxisParameters& p, double r, NominalModel& m) {
  const emulator::DisturbanceParameters& d = p.disturbances;
  const double zero_rad = radians(d.gravity.zero_at_deg);
  m.terms[Key::kGravitySine] = d.gravity.torque_Nm * std::cos(zero_rad);
  m.terms[Key::kGravityCosine] = d.gravity.torque_Nm * std::sin(zero_rad);
  const double load_kg = (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) / (r * r);
  m.bias_N = load_kg * kGravity_m_per_s2 * std::sin(radians(d.tilt_deg));
  m.cable_N_per_m = d.cable.stiffness_N_per_m;
  m.cable_at_m = d.cable.reference_m;
  for (std::size_t i = 0; i < d.position_force.position_m.size(); ++i) {
    m.force_at_m.push_back(d.position_force.position_m[i]);
    m.force_N.push_back(-d.position_force.torque_Nm[i] / r);
  }
}

// The axis has one wave of the wheel: a polygon beside an eccentricity is a wave of the reading.
void add_wheel(const AxisParameters& p, NominalModel& m) {
  const auto& wheel = p.disturbances.wheel;
  const double turns_per_m = 1 / (kTurn_rad * p.output_radius_m);
  if (wheel.eccentricity_m > 0 || wheel.teeth > 0) {
    m.terms[Key::kWheelDry] = p.friction.carriage_share;
  }
  if (wheel.eccentricity_m > 0) {
    const double share = wheel.eccentricity_m / p.output_radius_m;
    const double phase_rad = radians(wheel.eccentricity_phase_deg);
    m.terms[Key::kWheelCosine] = share * std::cos(phase_rad);
    m.terms[Key::kWheelSine] = -share * std::sin(phase_rad);
    m.terms[Key::kWheelPerMetre] = turns_per_m;
    if (wheel.teeth > 0) {
      m.terms[Key::kReadSine] = -2 * p.output_radius_m / std::pow(wheel.teeth, 3);
      m.terms[Key::kReadPerMetre] = wheel.teeth * turns_per_m;
    }
  } else if (wheel.teeth > 0) {
    m.terms[Key::kWheelCosine] = 2 / std::pow(wheel.teeth, 2);
    m.terms[Key::kWheelPerMetre] = wheel.teeth * turns_per_m;
  }
}

// One wave of a kind.
void add_waves(const emulator::RigAxisParameters& axis, double r, NominalModel& m) {
  const AxisParameters& p = axis.plant;
  const auto& ripple = p.disturbances.torque_ripple;
  if (ripple.amplitude_Nm > 0) {
    const double phase_rad = radians(ripple.phase_deg);
    m.terms[Key::kRippleCosine] = -ripple.amplitude_Nm / r * std::sin(phase_rad);
    m.terms[Key::kRippleSine] = -ripple.amplitude_Nm / r * std::cos(phase_rad);
    m.terms[Key::kRipplePerMetre] = ripple.periods_per_turn / (kTurn_rad * r);
  }
  add_wheel(p, m);
  if (axis.encoder.eccentricity_counts > 0) {
    const double off_m = axis.encoder.eccentricity_counts * m.metres_per_count;
    const double phase_rad = radians(axis.encoder.eccentricity_phase_deg);
    m.terms[Key::kReadCosine] = -off_m * std::sin(phase_rad);
    m.terms[Key::kReadSine] = off_m * std::cos(phase_rad);
    m.terms[Key::kReadPerMetre] = 1 / (kTurn_rad * r);
  }
}

void add_water(const emulator::WaterParameters& water, NominalModel& m) {
  m.mass_kg += emulator::added_mass_kg(water);
  for (const emulator::WaterBodyParameters& body : {water.shaft, water.object}) {
    if (!body.in_water) continue;
    m.viscous_N_s_per_m += body.linear_drag_N_s_per_m;
    m.terms[Key::kDrag] += body.quadratic_drag_N_s2_per_m2;
  }
}

}  // namespace

void add_stated_terms(const emulator::RigParameters& machine, core::Axis which,
                      NominalModel& model) {
  const emulator::RigAxisParameters& axis = machine.axes[which];
  const double r = metres_per_motor_rad(axis.plant);
  add_friction(axis.plant.friction, r, model);
  add_forces_by_place(axis.plant, r, model);
  add_waves(axis, r, model);
  if (machine.water.present() && core::is_planar(which)) add_water(machine.water, model);
}

}  // namespace towbench::study::diagnose
