// Masses that are not where the rigid model has them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kFrictionAtLoad = 0.65;  // of all friction, where nothing is stated
constexpr double kFlank_Hz = 50;          // of a load on its flank: stiff in the band
constexpr double kFlankDamping = 0.4;
constexpr double kTransmissionDamping = 0.05;

// A load behind a spring, by its frequency on a held motor and its share of the mass.
void set_transmission(Parameters& p, double mode_Hz, double damping_ratio, double load_share) {
  const double load = load_share * p[Key::kMass];
  const double w = 2 * std::numbers::pi * mode_Hz;
  p[Key::kMotorMass] = p[Key::kMass] - load;
  p[Key::kStiffness] = load * w * w;
  p[Key::kDamping] = 2 * damping_ratio * load * w;
  p[Key::kLoadShare] = kFrictionAtLoad;
}

void set_elastic(Parameters& p, const Context& /*c*/, std::span<const double> s) {
  set_transmission(p, s[0], kTransmissionDamping, s[1]);
}

void set_loose(Parameters& p, const Context& /*c*/, std::span<const double> s) {
  set_transmission(p, kFlank_Hz, kFlankDamping, s[1]);
  p[Key::kPlay] = s[0];
}

std::vector<Scales> modes(const Context& c) {
  std::vector<Scales> grid;
  for (const double mode_Hz : {3.0, 5.0, 8.0, 13.0, 21.0, 34.0}) {
    for (const double load : {0.5, 0.8}) {
      if (!c.stated.elastic() && mode_Hz * c.period_s < 0.2) grid.push_back({mode_Hz, load});
    }
  }
  return grid;
}

std::vector<Scales> plays(const Context& c) {
  std::vector<Scales> grid;
  const double least = std::max({0.5 * c.resolution_m, 1e-5 * c.stroke_m, 1e-7});
  for (double play = least; play < c.stroke_m / 20 && !c.stated.elastic(); play *= 2) {
    for (const double load : {0.5, 0.8}) grid.push_back({play, load});
  }
  return grid;
}

std::vector<Scales> where_elastic(const Context& c) {
  return c.stated.elastic() ? std::vector<Scales>{{}} : std::vector<Scales>{};
}

double stiffness_step(const Context& c) {
  return 0.01 * c.stated.transmission.stiffness_N_per_m;
}
double play_step(const Context& c) {
  return std::max(0.5 * c.resolution_m, 1e-6);
}

// Play is of the gear; other slack stays as stated.
PlantValues play_alone_values(const Parameters& p, const StatedPlant& stated) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double arc_m = p[Key::kPlay] - stated.slack_m;
  return arc_m >= 0 ? PlantValues{arc_m / stated.output_radius_m * kDegrees} : PlantValues{};
}

std::vector<std::string> play_keys() {
  std::vector<std::string> keys = transmission_keys();
  keys.emplace_back("gear.backlash_deg");
  return keys;
}
PlantValues play_values(const Parameters& p, const StatedPlant& stated) {
  PlantValues values = transmission_values(p, stated);
  const PlantValues play = play_alone_values(p, stated);
  if (values.empty() || play.empty()) return {};
  values.push_back(play.front());
  return values;
}

}  // namespace

void add_mechanical_effects(std::vector<Effect>& library) {
  const std::string resolved = "accelerations fast enough to excite it, finely resolved";
  const std::string reversals = "reversals, or a sensor on the load";
  library.push_back({.name = "chain_elasticity",
                     .cause = "an elastic transmission between motor and load",
                     .needs = resolved,
                     .law = "F_t = K d + B d', d of motor against load",
                     .source = "(3.37), (3.38)",
                     .scales = {Key::kStiffness, Key::kDamping, Key::kMotorMass, Key::kLoadShare},
                     .scale_names = {"stiffness_N_per_m", "damping_N_s_per_m", "motor_mass_kg",
                                     "friction_share_of_load"},
                     .positive = true,
                     .whole = 1,
                     .grid = modes,
                     .set = set_elastic,
                     .step = whole_step,
                     .plant_keys = transmission_keys(),
                     .plant_values = transmission_values});
  library.push_back({.name = "chain_elasticity",
                     .cause = "a transmission stiffer or softer, or damped otherwise, than stated",
                     .needs = resolved,
                     .law = "the same, K and B other than stated",
                     .source = "(3.37), (3.38)",
                     .amplitudes = {Key::kStiffness, Key::kDamping},
                     .amplitude_names = {"stiffness_N_per_m", "damping_N_s_per_m"},
                     .grid = where_elastic,
                     .set = set_nothing,
                     .step = stiffness_step,
                     .plant_keys = transmission_keys(),
                     .plant_values = transmission_values});
  library.push_back(
      {.name = "backlash",
       .cause = "play: after the load lets go of a flank the motor moves without it",
       .needs = reversals,
       .law = "F_t = 0 while |d| < p/2",
       .source = "Nordin, Gutman 2002",
       .scales = {Key::kPlay, Key::kMotorMass, Key::kStiffness, Key::kDamping, Key::kLoadShare},
       .scale_names = {"play_m", "motor_mass_kg", "stiffness_N_per_m", "damping_N_s_per_m",
                       "friction_share_of_load"},
       .positive = true,
       .whole = 1,
       .rough = true,
       .grid = plays,
       .set = set_loose,
       .step = whole_step,
       .plant_keys = play_keys(),
       .plant_values = play_values});
  library.push_back({.name = "backlash",
                     .cause = "play: after the load lets go of a flank the motor moves without it",
                     .needs = reversals,
                     .law = "F_t = 0 while |d| < p/2",
                     .source = "Nordin, Gutman 2002",
                     .amplitudes = {Key::kPlay},
                     .amplitude_names = {"play_m"},
                     .positive = true,
                     .grid = where_elastic,
                     .set = set_nothing,
                     .step = play_step,
                     .plant_keys = {"gear.backlash_deg"},
                     .plant_values = play_alone_values});
}

}  // namespace towbench::study::diagnose
