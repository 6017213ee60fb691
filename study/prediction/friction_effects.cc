// Friction: by direction, speed, load, path and time; laws of 3.2.2 of the thesis and their kin.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

std::vector<Scales> low_speeds(const Context& c) {
  return multiples({0.01, 0.03, 0.08, 0.2}, c.top_speed_m_per_s);
}

// Travel after a reversal: from what the encoder resolves to a twentieth of the stroke. Damped by a
// quarter of what is critical if all dry friction is that of bristles.
std::vector<Scales> travels(const Context& c) {
  constexpr double kDampingRatio = 0.25;
  std::vector<Scales> grid;
  const double shortest = std::max(3 * c.resolution_m, 1e-4 * c.stroke_m);
  const double friction_N = std::max(c.stated.coulomb_N, 0.1 * c.input_rms_N);
  for (double travel = shortest; travel < c.stroke_m / 20; travel *= 3) {
    grid.push_back({travel, 2 * kDampingRatio * std::sqrt(c.stated.mass_kg * travel / friction_N)});
  }
  return grid;
}
// Of kPresliding, with which nothing but bristles is left.
double all_friction(const Context& c) {
  return 2 * std::max(c.stated.coulomb_N, 0.1 * c.input_rms_N);
}
void set_bristles(Parameters& p, const Context& /*c*/, std::span<const double> scales) {
  p[Key::kPreslidingTravel] = scales[0];
  p[Key::kPreslidingTime] = scales[1];
}

std::vector<Scales> warming_times(const Context& c) {
  return multiples({0.15, 0.5, 5}, c.duration_s);
}

std::vector<Scales> where_warm(const Context& c) {
  constexpr double kLeast_K = 0.5;
  return c.temperature_range_K > kLeast_K ? std::vector<Scales>{{}} : std::vector<Scales>{};
}
double temperature_step(const Context& c) {
  return force_step(c) / c.temperature_range_K;
}

// Of a level: a tenth of it must be left.
constexpr double kMostTaken = 0.9;
constexpr double kDrySpring = 0.5;  // of kPresliding, that follows the way

// Break-away is alike in both directions, unless it would lie below what slides.
PlantValues coulomb_asymmetry_values(const Parameters& p, const StatedPlant& stated) {
  const FileFriction f = file_friction(p, stated);
  const double share = p[Key::kCoulombAsymmetry] / f.coulomb_N;
  if (!(std::abs(share) <= kMostTaken)) return {};
  const double breakaway_N = f.coulomb_N + f.excess_N;
  const bool below = breakaway_N < f.coulomb_N * (1 + std::abs(share));
  return {share, below ? share * f.coulomb_N / breakaway_N : 0.0};
}

PlantValues viscous_asymmetry_values(const Parameters& p, const StatedPlant& /*stated*/) {
  const double share = p[Key::kViscousAsymmetry] / p[Key::kViscous];
  return std::abs(share) <= kMostTaken ? PlantValues{share} : PlantValues{};
}

// What holds the object is in the water, too.
PlantValues drag_values(const Parameters& p, const StatedPlant& stated) {
  const double drag = p[Key::kDrag] - stated.shaft_drag_N_s2_per_m2;
  return stated.in_water_plane && drag >= 0 ? PlantValues{true, drag} : PlantValues{};
}

PlantValues load_friction_values(const Parameters& p, const StatedPlant& /*stated*/) {
  return {std::max(0.0, p[Key::kLoadFriction])};
}

const std::vector<std::string> kStribeckKeys{
    "friction.breakaway_Nm", "friction.stribeck_speed_rad_per_s", "friction.stribeck_form"};
// Also what only leaves rest: the plant has one curve for both. Of two scales, none.
PlantValues stribeck_values(const Parameters& p, const StatedPlant& stated) {
  if (p[Key::kStribeck] != 0 && p[Key::kBreakaway] != 0) return {};
  const FileFriction f = file_friction(p, stated);
  const double r = stated.metres_per_motor_rad;
  const bool falls_both_ways = p[Key::kStribeck] != 0;
  const bool lorentz = falls_both_ways && stated.model.stribeck_is_lorentz;
  return {(f.coulomb_N + f.excess_N) * r,
          p[falls_both_ways ? Key::kStribeckSpeed : Key::kBreakawaySpeed] / r,
          std::string(lorentz ? "lorentz" : "gaussian")};
}

// Dahl's bristles as Prandtl's element that takes as much work from a reversal: 2 b l = 2 C travel,
// and, at any speed, as much of it by damping.
PlantValues presliding_values(const Parameters& p, const StatedPlant& stated) {
  const double coulomb_N = p[Key::kCoulomb];
  const double bristles_N = std::min(kDrySpring * p[Key::kPresliding], coulomb_N);
  if (coulomb_N <= 0) return {};
  const double travel_m = p[Key::kPreslidingTravel] * bristles_N / coulomb_N;
  const FileFriction f = file_friction(p, stated);
  const double critical = 2 * std::sqrt((f.coulomb_N + f.excess_N) * p[Key::kMass] / travel_m);
  const double damping =
      kPrandtlDamping * coulomb_N * p[Key::kPreslidingTime] / p[Key::kPreslidingTravel];
  return {travel_m / stated.metres_per_motor_rad, damping / critical};
}

// k W = depth W' of a store that the power depth C v_top / k fills.
PlantValues warming_values(const Parameters& p, const StatedPlant& stated) {
  const double k = p[Key::kWorkWarming];
  if (k <= 0 || k > kMostTaken) return {};
  return {kMostTaken, kMostTaken * p[Key::kCoulomb] * stated.top_speed_m_per_s / k,
          p[Key::kWorkWarmingTime]};
}

}  // namespace

void add_friction_effects(std::vector<Effect>& library) {
  const std::string both = "motion in both directions";
  const std::string slow = "slow motion through zero speed, repeated";
  const std::string fast = "steady speeds up to the highest used";
  library.push_back({.name = "coulomb_asymmetry",
                     .cause = "dry friction that differs between the two directions",
                     .needs = both,
                     .law = "dry friction C + d sgn v",
                     .source = "Armstrong-Helouvry 1991",
                     .amplitudes = {Key::kCoulombAsymmetry},
                     .amplitude_names = {"half_difference_N"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step,
                     .plant_keys = {"friction.asymmetry.coulomb", "friction.asymmetry.breakaway"},
                     .plant_values = coulomb_asymmetry_values});
  library.push_back({.name = "viscous_asymmetry",
                     .cause = "viscous friction that differs between the two directions",
                     .needs = "both directions, each at two or more speeds",
                     .law = "d |v|",
                     .source = "Armstrong-Helouvry 1991",
                     .amplitudes = {Key::kViscousAsymmetry},
                     .amplitude_names = {"half_difference_N_s_per_m"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = viscous_step,
                     .plant_keys = {"friction.asymmetry.viscous"},
                     .plant_values = viscous_asymmetry_values});
  library.push_back(
      {.name = "quadratic_drag",
       .cause = "drag growing with the square of speed",
       .needs = fast,
       .law = "D v |v|",
       .source = "(3.7)",
       .amplitudes = {Key::kDrag},
       .amplitude_names = {"drag_N_s2_per_m2"},
       .positive = true,
       .grid = no_scale,
       .set = set_nothing,
       .step = drag_step,
       .plant_keys = {"water.object.in_water", "water.object.quadratic_drag_N_s2_per_m2"},
       .plant_values = drag_values});
  library.push_back({.name = "cubic_viscous",
                     .cause = "friction growing with the cube of speed",
                     .needs = fast,
                     .law = "k v^3",
                     .source = "assumed: the next odd power of speed",
                     .amplitudes = {Key::kCubic},
                     .amplitude_names = {"coefficient_N_s3_per_m3"},
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = cubic_step});
  library.push_back({.name = "load_dependent_friction",
                     .cause = "friction growing with the transmitted force",
                     .needs = "accelerating and coasting at the same speed",
                     .law = "dry friction + mu |F|, F that the transmission passes on",
                     .source = "Hamon, Gautier, Garrec 2010",
                     .amplitudes = {Key::kLoadFriction},
                     .amplitude_names = {"friction_per_load_ratio"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = share_step,
                     .plant_keys = {"friction.load_ratio"},
                     .plant_values = load_friction_values});
  library.push_back(
      {.name = "stribeck",
       .cause = "friction rising towards zero speed (Stribeck)",
       .needs = slow,
       .law = "dry friction + d exp(-(v/v_s)^2), or d / (1 + (v/v_s)^2) where the file says so",
       .source = "(3.25), (3.26)",
       .amplitudes = {Key::kStribeck},
       .amplitude_names = {"rise_N"},
       .scales = {Key::kStribeckSpeed},
       .scale_names = {"stribeck_speed_m_per_s"},
       .positive = true,
       .grid = low_speeds,
       .set = set_scale<Key::kStribeckSpeed>,
       .step = force_step,
       .plant_keys = kStribeckKeys,
       .plant_values = stribeck_values});
  library.push_back({.name = "low_speed_rolloff",
                     .cause = "friction falling towards zero speed",
                     .needs = slow,
                     .law = "dry friction - d exp(-|v|/v_s)",
                     .source = "assumed",
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
                     .law = "dry friction + d exp(-(v/v_s)^2), at rest and while speed grows",
                     .source = "Karnopp 1985",
                     .amplitudes = {Key::kBreakaway},
                     .amplitude_names = {"excess_N"},
                     .scales = {Key::kBreakawaySpeed},
                     .scale_names = {"speed_scale_m_per_s"},
                     .positive = true,
                     .grid = low_speeds,
                     .set = set_scale<Key::kBreakawaySpeed>,
                     .step = force_step,
                     .plant_keys = kStribeckKeys,
                     .plant_values = stribeck_values});
  library.push_back(
      {.name = "presliding",
       .cause = "friction that builds up over a path after each reversal",
       .needs = "small reversals at two speeds",
       .law = "dry friction - d/2 (1 - z sgn v) + d/2 (T/l) (1 - |z|) |v|, l dz/d|x| = sgn v - z",
       .source = "Dahl 1968",
       .amplitudes = {Key::kPresliding},
       .amplitude_names = {"missing_at_reversal_N"},
       .scales = {Key::kPreslidingTravel, Key::kPreslidingTime},
       .scale_names = {"travel_m", "damping_s"},
       .positive = true,
       .grid = travels,
       .set = set_bristles,
       .step = force_step,
       .far_step = all_friction,
       .plant_keys = {"friction.presliding.travel_rad", "friction.presliding.damping_ratio"},
       .plant_values = presliding_values});
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that changes in the course of the session",
                     .needs = "the same motion cold and warm",
                     .law = "dry friction - d (1 - exp(-t/T)), t since the session began",
                     .source = "assumed: one heat store",
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
                     .law = "dry friction (1 - k W), T W' = power / power at top speed - W",
                     .source = "assumed: one heat store",
                     .amplitudes = {Key::kWorkWarming},
                     .amplitude_names = {"fall_at_top_speed_ratio"},
                     .scales = {Key::kWorkWarmingTime},
                     .scale_names = {"time_constant_s"},
                     .shares_mean_with = Key::kCoulomb,
                     .grid = warming_times,
                     .set = set_scale<Key::kWorkWarmingTime>,
                     .step = share_step,
                     .plant_keys = {"friction.warming.depth", "friction.warming.full_power_W",
                                    "friction.warming.time_constant_s"},
                     .plant_values = warming_values});
  library.push_back({.name = "temperature_friction",
                     .cause = "friction that falls with the measured temperature",
                     .needs = "a log that has the temperature, cold and warm",
                     .law = "dry friction - d (T - mean), viscous friction - b (T - mean)",
                     .source = "Bittencourt, Gunnarsson 2012; here linear in T",
                     .amplitudes = {Key::kTemperatureDry, Key::kTemperatureViscous},
                     .amplitude_names = {"dry_fall_N_per_K", "viscous_fall_N_s_per_m_per_K"},
                     .grid = where_warm,
                     .set = set_nothing,
                     .step = temperature_step});
}

}  // namespace towbench::study::diagnose
