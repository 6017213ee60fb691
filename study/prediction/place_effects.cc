// Forces and friction that depend on where the axis is, (3.34) and (4.2).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

std::vector<Key> shapes(Key from) {
  std::vector<Key> keys;
  for (int k = 0; k < kShapes; ++k) keys.push_back(next(from, k));
  return keys;
}

std::vector<std::string> shape_names(const std::string& unit) {
  std::vector<std::string> names;
  for (int k = 1; k <= kShapes; ++k) names.push_back("cos" + std::to_string(k) + "_" + unit);
  return names;
}

std::vector<Scales> where_rotary(const Context& c) {
  return c.stated.rotary ? std::vector<Scales>{{}} : std::vector<Scales>{};
}

double cable_step(const Context& c) {
  return force_step(c) / c.stroke_m;
}

// s sin q + c cos q = m g l sin(q + q0)
PlantValues gravity_values(const Parameters& p, const StatedPlant& /*stated*/) {
  const double sine = p[Key::kGravitySine];
  const double cosine = p[Key::kGravityCosine];
  return {std::hypot(sine, cosine), std::atan2(cosine, sine) * 180 / std::numbers::pi};
}

// With a cable that is stated: one that pulls like both.
PlantValues cable_values(const Parameters& p, const StatedPlant& stated) {
  const NominalModel& m = stated.model;
  const double both = p[Key::kCable] + m.cable_N_per_m;
  const double middle_m = stated.stroke_min_m + 0.5 * stated.stroke_m;
  if (both <= 0) return {};
  return {both, (p[Key::kCable] * middle_m + m.cable_N_per_m * m.cable_at_m) / both};
}

PlantValues position_friction_values(const Parameters& p, const StatedPlant& stated) {
  FileFriction f = file_friction(p, stated);
  for (double& value : f.added_N) value *= stated.metres_per_motor_rad;
  return {std::move(f.at_m), std::move(f.added_N)};
}

}  // namespace

void add_place_effects(std::vector<Effect>& library) {
  const std::string stretch = "the same stretch in both directions, at two speeds";
  library.push_back(
      {.name = "gravity",
       .cause = "the weight of a joint",
       .needs = "a quarter of a turn or more",
       .law = "s sin q + c cos q",
       .source = "physical pendulum",
       .amplitudes = {Key::kGravitySine, Key::kGravityCosine},
       .amplitude_names = {"sine_Nm", "cosine_Nm"},
       .structural = true,
       .shares_mean_with = Key::kBias,
       .grid = where_rotary,
       .set = set_nothing,
       .step = force_step,
       .plant_keys = {"disturbances.gravity.torque_Nm", "disturbances.gravity.zero_at_deg"},
       .plant_values = gravity_values});
  library.push_back({.name = "position_force",
                     .cause = "a force that depends on position, the same in both directions",
                     .needs = stretch,
                     .law = "sum a_k cos(k pi x), k = 1 to 6, x over the stroke",
                     .source = "(4.2), tau_P outside the sign",
                     .amplitudes = shapes(Key::kPlaceForce1),
                     .amplitude_names = shape_names("N"),
                     .covers = "cable_spring",
                     .flexible = true,
                     .along = "position",
                     .shares_mean_with = Key::kBias,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step,
                     .plant_keys = position_force_keys(),
                     .plant_values = position_force_values});
  library.push_back(
      {.name = "cable_spring",
       .cause = "a force growing with position, as a cable or a tilt change makes",
       .needs = stretch,
       .law = "K (x - middle of the stroke)",
       .source = "linear spring",
       .amplitudes = {Key::kCable},
       .amplitude_names = {"stiffness_N_per_m"},
       .shares_mean_with = Key::kBias,
       .grid = no_scale,
       .set = set_nothing,
       .step = cable_step,
       .plant_keys = {"disturbances.cable.stiffness_N_per_m", "disturbances.cable.reference_m"},
       .plant_values = cable_values});
  library.push_back(
      {.name = "position_friction",
       .cause = "dry friction that depends on position",
       .needs = stretch,
       .law = "dry friction + sum a_k cos(k pi x), k = 1 to 6",
       .source = "(3.34)",
       .amplitudes = shapes(Key::kPlaceFriction1),
       .amplitude_names = shape_names("N"),
       .flexible = true,
       .shares_mean_with = Key::kCoulomb,
       .grid = no_scale,
       .set = set_nothing,
       .step = force_step,
       .plant_keys = {"friction.position.position_m", "friction.position.friction_Nm"},
       .plant_values = position_friction_values});
  library.push_back({.name = "position_viscous",
                     .cause = "viscous friction that depends on position",
                     .needs = stretch,
                     .law = "v sum a_k cos(k pi x), k = 1 to 6",
                     .source = "assumed: (3.34) of viscous friction",
                     .amplitudes = shapes(Key::kPlaceViscous1),
                     .amplitude_names = shape_names("N_s_per_m"),
                     .flexible = true,
                     .along = "position times speed",
                     .finer = 0.2,
                     .shares_mean_with = Key::kViscous,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = viscous_step});
}

}  // namespace towbench::study::diagnose
