// Friction: by direction, speed, load, path and time; laws of 3.2.2 of the thesis and their kin.
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

std::vector<Scales> low_speeds(const Context& c) {
  return multiples({0.01, 0.03, 0.08, 0.2}, c.top_speed_m_per_s);
}

// Travel after a reversal: from what the encoder resolves to a twentieth of the stroke.
std::vector<Scales> travels(const Context& c) {
  std::vector<Scales> grid;
  const double shortest = std::max(3 * c.resolution_m, 1e-4 * c.stroke_m);
  for (double travel = shortest; travel < c.stroke_m / 20; travel *= 3) {
    grid.push_back({travel});
  }
  return grid;
}

std::vector<Scales> warming_times(const Context& c) {
  return multiples({0.15, 0.5, 5}, c.duration_s);
}

}  // namespace

void add_friction_effects(std::vector<Effect>& library) {
  const std::string both = "motion in both directions";
  const std::string slow = "slow motion through zero speed, repeated";
  const std::string fast = "steady speeds up to the highest used";
  library.push_back({.name = "coulomb_asymmetry",
                     .cause = "dry friction that differs between the two directions",
                     .needs = both,
                     .amplitudes = {Key::kCoulombAsymmetry},
                     .amplitude_names = {"half_difference_N"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step});
  library.push_back({.name = "viscous_asymmetry",
                     .cause = "viscous friction that differs between the two directions",
                     .needs = "both directions, each at two or more speeds",
                     .amplitudes = {Key::kViscousAsymmetry},
                     .amplitude_names = {"half_difference_N_s_per_m"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = viscous_step});
  library.push_back({.name = "quadratic_drag",
                     .cause = "drag growing with the square of speed",
                     .needs = fast,
                     .amplitudes = {Key::kDrag},
                     .amplitude_names = {"drag_N_s2_per_m2"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = drag_step});
  library.push_back({.name = "cubic_viscous",
                     .cause = "friction growing with the cube of speed",
                     .needs = fast,
                     .amplitudes = {Key::kCubic},
                     .amplitude_names = {"coefficient_N_s3_per_m3"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = cubic_step});
  library.push_back({.name = "load_dependent_friction",
                     .cause = "friction growing with the transmitted force",
                     .needs = "accelerating and coasting at the same speed",
                     .amplitudes = {Key::kLoadFriction},
                     .amplitude_names = {"friction_per_load_ratio"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = share_step});
  library.push_back({.name = "stribeck",
                     .cause = "friction rising towards zero speed (Stribeck)",
                     .needs = slow,
                     .amplitudes = {Key::kStribeck},
                     .amplitude_names = {"rise_N"},
                     .scales = {Key::kStribeckSpeed},
                     .scale_names = {"stribeck_speed_m_per_s"},
                     .positive = true,
                     .grid = low_speeds,
                     .set = set_scale<Key::kStribeckSpeed>,
                     .step = force_step});
  library.push_back({.name = "low_speed_rolloff",
                     .cause = "friction falling towards zero speed",
                     .needs = slow,
                     .amplitudes = {Key::kRolloff},
                     .amplitude_names = {"fall_N"},
                     .scales = {Key::kRolloffSpeed},
                     .scale_names = {"speed_scale_m_per_s"},
                     .positive = true,
                     .grid = low_speeds,
                     .set = set_scale<Key::kRolloffSpeed>,
                     .step = force_step});
  library.push_back({.name = "stiction",
                     .cause = "a break-away force above the sliding friction",
                     .needs = "many starts from rest, with slow ramps",
                     .amplitudes = {Key::kBreakaway},
                     .amplitude_names = {"excess_N"},
                     .scales = {Key::kBreakawaySpeed},
                     .scale_names = {"speed_scale_m_per_s"},
                     .positive = true,
                     .grid = low_speeds,
                     .set = set_scale<Key::kBreakawaySpeed>,
                     .step = force_step});
  library.push_back({.name = "presliding",
                     .cause = "friction that builds up over a path after each reversal",
                     .needs = "small reversals at two speeds",
                     .amplitudes = {Key::kPresliding},
                     .amplitude_names = {"missing_at_reversal_N"},
                     .scales = {Key::kPreslidingTravel},
                     .scale_names = {"travel_m"},
                     .positive = true,
                     .grid = travels,
                     .set = set_scale<Key::kPreslidingTravel>,
                     .step = force_step});
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that changes in the course of the session",
                     .needs = "the same motion cold and warm",
                     .amplitudes = {Key::kWarming},
                     .amplitude_names = {"fall_over_session_N"},
                     .scales = {Key::kWarmingTime},
                     .scale_names = {"time_constant_s"},
                     .shares_mean_with = Key::kCoulomb,
                     .grid = warming_times,
                     .set = set_scale<Key::kWarmingTime>,
                     .step = force_step});
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that falls with what it has dissipated",
                     .needs = "the same motion cold and warm",
                     .amplitudes = {Key::kWorkWarming},
                     .amplitude_names = {"fall_at_top_speed_ratio"},
                     .scales = {Key::kWorkWarmingTime},
                     .scale_names = {"time_constant_s"},
                     .shares_mean_with = Key::kCoulomb,
                     .grid = warming_times,
                     .set = set_scale<Key::kWorkWarmingTime>,
                     .step = share_step});
}

}  // namespace towbench::study::diagnose
