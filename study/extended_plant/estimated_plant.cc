#include "study/extended_plant/estimated_plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace towbench::study::diagnose {
namespace {

constexpr double kFull_V = 10;         // at the amplifier's input
constexpr double kSupply_V = 60;       // the most that a plant file can state
constexpr double kBackEmf_V = 20;      // at the log's top speed
constexpr double kDrop_V = 5;          // at the winding, at full current
constexpr double kWinding_s = 0.4e-3;  // time constant
constexpr double kGear = 100;          // of a joint
constexpr double kTurn_m = 0.05;       // that a motor turn moves the load (plant_axis_reader.h)
constexpr double kFewestCounts = 4;    // a motor turn
constexpr double kMostCounts = 40'000;

// As large as the log's step where the file can say it.
double counts_per_turn(const Diagnosis& d, double turn_m) {
  const double step_m = d.context.resolution_m;
  const double counts = step_m > 0 ? turn_m / step_m : kMostCounts;
  return 4 * std::round(std::clamp(counts, kFewestCounts, kMostCounts) / 4);
}

}  // namespace

toml::table estimated_plant(const Diagnosis& d) {
  const auto at_least_0 = [&](Key key) { return std::max(0.0, d.extended[key]); };
  const double most_N = d.context.input_max_N;
  const double most_A = most_N * std::max(1e-6, d.context.top_speed_m_per_s) / kBackEmf_V;
  const double ohm = std::clamp(kDrop_V / most_A, 1e-3, 1e3);  // that a plant file can state
  const bool turns = d.context.stated.rotary;
  // Softer stops could be stepped with a lighter load, too.
  toml::table no_stops{{"fitted", false},
                       {turns ? "stiffness_Nm_per_rad" : "stiffness_N_per_m", 1e3},
                       {turns ? "damping_Nm_s_per_rad" : "damping_N_s_per_m", 0.0}};
  toml::table axis{{"pwm_amplitude_V", kFull_V},
                   {"amplifier_gain_A_per_V", most_A / kFull_V},
                   {"current_limit_A", most_A},
                   {"hard_ends", std::move(no_stops)},
                   {"winding", toml::table{{"resistance_ohm", ohm},
                                           {"inductance_H", std::max(1e-6, ohm * kWinding_s)},
                                           {"choke_inductance_H", 0.0}}}};
  if (turns) {
    constexpr double r = 1 / kGear;
    axis.insert("transmission", toml::table{{"kind", "gear"}, {"gear_ratio", kGear}});
    axis.insert("inertia_kg_m2", d.extended[Key::kMass] * r * r);
    axis.insert("viscous_friction_Nm_s_per_rad", at_least_0(Key::kViscous) * r * r);
    axis.insert("coulomb_friction_Nm", at_least_0(Key::kCoulomb) * r);
    axis.insert("torque_constant_Nm_per_A", most_N * r / most_A);
    axis.insert("encoder_counts_per_rev",
                static_cast<std::int64_t>(counts_per_turn(d, 2 * std::numbers::pi * r)));
  } else {
    axis.insert("mass_kg", d.extended[Key::kMass]);
    axis.insert("viscous_friction_N_s_per_m", at_least_0(Key::kViscous));
    axis.insert("coulomb_friction_N", at_least_0(Key::kCoulomb));
    axis.insert("force_gain_N_per_V", most_N / kFull_V);
    axis.insert("encoder_counts_per_m", counts_per_turn(d, kTurn_m) / kTurn_m);
  }
  return toml::table{
      {"schema", 1},
      {"supply", toml::table{{"voltage_V", kSupply_V}, {"over_current_A", 2 * most_A}}},
      {"axis", toml::table{{d.context.stated.axis, std::move(axis)}}}};
}

}  // namespace towbench::study::diagnose
