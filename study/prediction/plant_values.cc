#include "study/prediction/plant_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/prediction/scene.h"

namespace towbench::study::diagnose {
namespace {

constexpr int kKnots = 31;          // of the 32 that a table of the plant file holds
constexpr double kSteepest = 0.17;  // sine of a tilt that rails may have, 10 degrees

bool is_elastic(const Parameters& p) {
  return p[Key::kMotorMass] > 0;
}

}  // namespace

std::vector<std::string> transmission_keys() {
  return {"rotor_inertia_kg_m2", "elasticity.resonance_Hz", "elasticity.damping_ratio",
          "friction.carriage_share"};
}
std::vector<std::string> position_force_keys() {
  return {"disturbances.position_force.position_m", "disturbances.position_force.torque_Nm"};
}

Knots knots_of(const Parameters& p, Key first, const StatedPlant& stated) {
  Knots knots;
  for (int knot = 0; knot < kKnots; ++knot) {
    const double x = static_cast<double>(knot) / (kKnots - 1);
    double sum = 0;
    for (int k = 0; k < kShapes; ++k) {
      sum += p[next(first, k)] * std::cos((k + 1) * std::numbers::pi * x);
    }
    knots.at_m.push_back(stated.stroke_min_m + x * stated.stroke_m);
    knots.value.push_back(sum);
  }
  return knots;
}

FileFriction file_friction(const Parameters& p, const StatedPlant& stated) {
  FileFriction out;
  out.coulomb_N = std::max(0.0, p[Key::kCoulomb]);
  out.excess_N = std::max(0.0, p[Key::kStribeck] + p[Key::kBreakaway]);
  Knots knots = knots_of(p, Key::kPlaceFriction1, stated);
  for (std::size_t i = 0; i < knots.at_m.size(); ++i) {
    knots.value[i] += stated_friction_N(stated.model, knots.at_m[i]);
  }
  const double least = std::min(0.0, *std::min_element(knots.value.begin(), knots.value.end()));
  for (double& value : knots.value) value -= least;
  out.coulomb_N = std::max(0.0, out.coulomb_N + least);
  out.at_m = std::move(knots.at_m);
  out.added_N = std::move(knots.value);
  return out;
}

double motor_kg(const Parameters& p, const StatedPlant& stated) {
  return is_elastic(p) ? p[Key::kMotorMass]
                       : stated.rotor_share * (p[Key::kMass] - stated.water_kg);
}

double load_kg(const Parameters& p, const StatedPlant& stated) {
  return p[Key::kMass] - stated.water_kg - motor_kg(p, stated);
}

PlantValues transmission_values(const Parameters& p, const StatedPlant& stated) {
  const double motor = motor_kg(p, stated);
  const double load = load_kg(p, stated);
  if (!is_elastic(p) || motor <= 0 || load <= 0 || p[Key::kStiffness] <= 0) return {};
  const double mobility = 1 / motor + 1 / load;
  const double w = std::sqrt(p[Key::kStiffness] * mobility);
  const double damping_ratio = std::max(0.0, p[Key::kDamping]) * mobility / (2 * w);
  const double r = stated.metres_per_motor_rad;
  return {motor * r * r, w / (2 * std::numbers::pi), damping_ratio,
          std::clamp(p[Key::kLoadShare], 0.0, 1.0)};
}

PlantValues tilt_values(const Parameters& p, const StatedPlant& stated) {
  constexpr double kGravity_m_per_s2 = 9.80665;
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double sine = p[Key::kBias] / (std::max(1e-9, load_kg(p, stated)) * kGravity_m_per_s2);
  if (stated.model.rotary || std::abs(sine) > kSteepest) return {};
  return {std::asin(sine) * kDegrees};
}

// The force that pushes, as a torque at the motor.
PlantValues position_force_values(const Parameters& p, const StatedPlant& stated) {
  Knots knots = knots_of(p, Key::kPlaceForce1, stated);
  const double constant_N = tilt_values(p, stated).empty() ? p[Key::kBias] : 0.0;
  for (std::size_t i = 0; i < knots.at_m.size(); ++i) {
    const double cable_N = stated.model.cable_N_per_m * (knots.at_m[i] - stated.model.cable_at_m);
    const double stated_N = stated_force_N(stated.model, knots.at_m[i]) - cable_N;
    knots.value[i] = -(knots.value[i] + stated_N + constant_N) * stated.metres_per_motor_rad;
  }
  return {std::move(knots.at_m), std::move(knots.value)};
}

}  // namespace towbench::study::diagnose
