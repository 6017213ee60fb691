// Hides every effect under many seeds and prints what the diagnosis calls it.
//
//   diagnose_campaign [SEEDS [STRENGTH [EFFECT...]]]        in a rigid axis, by another generator
//   diagnose_campaign bench [SEEDS [STRENGTH [EFFECT...]]]  in the emulator, under BBMC
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/harness/diagnose/bench_case.h"
#include "tests/harness/diagnose/hidden_case.h"

namespace {

using towbench::tests::HiddenAxis;

const std::vector<std::string> kAll{"",
                                    "coulomb_asymmetry",
                                    "viscous_asymmetry",
                                    "stribeck",
                                    "low_speed_rolloff",
                                    "stiction",
                                    "presliding",
                                    "quadratic_drag",
                                    "cubic_viscous",
                                    "added_mass",
                                    "backlash",
                                    "chain_elasticity",
                                    "transport_delay",
                                    "current_loop_lag",
                                    "amplifier_gain",
                                    "amplifier_deadband",
                                    "command_saturation",
                                    "voltage_saturation",
                                    "load_dependent_friction",
                                    "position_force",
                                    "cable_spring",
                                    "position_friction",
                                    "position_viscous",
                                    "torque_ripple",
                                    "sprocket_eccentricity",
                                    "chain_polygon",
                                    "thermal_drift",
                                    "constant_bias",
                                    "encoder_eccentricity",
                                    "encoder_count_loss",
                                    "periodic_force",
                                    "outside"};

bool holds(const std::vector<std::string>& names, const std::string& name) {
  for (const auto& other : names) {
    if (other == name) return true;
  }
  return false;
}

struct Tally {
  int hit = 0;
  int unexplained = 0;
  int extra = 0;
  std::map<std::string, int> names;
};

Tally run(const std::string& effect, double strength, int seeds, bool on_bench) {
  Tally tally;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto drawn = static_cast<std::uint64_t>(seed);
    HiddenAxis axis;
    axis.effect = effect;
    axis.strength = strength;
    const auto d = on_bench ? towbench::tests::diagnose_bench({effect, strength, drawn})
                            : towbench::tests::diagnose_hidden(axis, drawn);
    bool found = false;
    bool wrong = false;
    for (const auto& names : towbench::tests::named(d)) {
      (holds(names, effect) ? found : wrong) = true;
      std::string all = names.front();
      for (std::size_t i = 1; i < names.size(); ++i) all += "~" + names[i];
      ++tally.names[all];
    }
    tally.hit += (effect.empty() || effect == "outside" ? !wrong : found && !wrong) ? 1 : 0;
    tally.extra += wrong ? 1 : 0;
    tally.unexplained += d.unexplained ? 1 : 0;
  }
  return tally;
}

}  // namespace

int main(int argc, char** argv) {
  const bool on_bench = argc > 1 && std::string_view(argv[1]) == "bench";
  if (on_bench) {
    --argc;
    ++argv;
  }
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 3;
  const double strength = argc > 2 ? std::atof(argv[2]) : 1.0;
  std::vector<std::string> effects(argv + std::min(argc, 3), argv + argc);
  if (effects.empty()) {
    effects = on_bench ? towbench::tests::bench_effects() : kAll;
    if (on_bench) effects.insert(effects.begin(), std::string());
  }
  fmt::print(
      "| hidden | right and alone | other names | unexplained | named |\n|---|---|---|---|---|\n");
  for (const auto& effect : effects) {
    const Tally t = run(effect == "nothing" ? "" : effect, strength, seeds, on_bench);
    std::string names;
    for (const auto& [name, count] : t.names) names += fmt::format("{} x{}; ", name, count);
    fmt::print("| {} | {}/{} | {} | {} | {} |\n", effect.empty() ? "nothing" : effect, t.hit, seeds,
               t.extra, t.unexplained, names);
    std::fflush(stdout);
  }
  return 0;
}
