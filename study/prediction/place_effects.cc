// Forces and friction that depend on where the axis is, (3.34) and (4.2).
#include <algorithm>
#include <numbers>
#include <string>
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

}  // namespace

void add_place_effects(std::vector<Effect>& library) {
  const std::string stretch = "the same stretch in both directions, at two speeds";
  library.push_back({.name = "gravity",
                     .cause = "the weight of a joint",
                     .needs = "a quarter of a turn or more",
                     .amplitudes = {Key::kGravitySine, Key::kGravityCosine},
                     .amplitude_names = {"sine_Nm", "cosine_Nm"},
                     .structural = true,
                     .shares_mean_with = Key::kBias,
                     .grid = where_rotary,
                     .set = set_nothing,
                     .step = force_step});
  library.push_back({.name = "position_force",
                     .cause = "a force that depends on position, the same in both directions",
                     .needs = stretch,
                     .amplitudes = shapes(Key::kPlaceForce1),
                     .amplitude_names = shape_names("N"),
                     .covers = "cable_spring",
                     .flexible = true,
                     .shares_mean_with = Key::kBias,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step});
  library.push_back({.name = "cable_spring",
                     .cause = "a force growing with position, as a cable or a tilt change makes",
                     .needs = stretch,
                     .amplitudes = {Key::kCable},
                     .amplitude_names = {"stiffness_N_per_m"},
                     .shares_mean_with = Key::kBias,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = cable_step});
  library.push_back({.name = "position_friction",
                     .cause = "dry friction that depends on position",
                     .needs = stretch,
                     .amplitudes = shapes(Key::kPlaceFriction1),
                     .amplitude_names = shape_names("N"),
                     .flexible = true,
                     .shares_mean_with = Key::kCoulomb,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step});
  library.push_back({.name = "position_viscous",
                     .cause = "viscous friction that depends on position",
                     .needs = stretch,
                     .amplitudes = shapes(Key::kPlaceViscous1),
                     .amplitude_names = shape_names("N_s_per_m"),
                     .flexible = true,
                     .shares_mean_with = Key::kViscous,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = viscous_step});
}

}  // namespace towbench::study::diagnose
