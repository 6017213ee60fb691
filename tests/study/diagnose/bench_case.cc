#include "tests/study/diagnose/bench_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "core/random.h"
#include "emulator/plant/derived_mechanics.h"
#include "study/commands/plant_model.h"
#include "study/procedures/machine.h"

namespace towbench::tests {
namespace {

using namespace study;
using emulator::RigAxisParameters;

constexpr core::Axis kY = core::Axis::kY;
constexpr const char* kRig = "fixtures/rigs/macs-nominal.toml";
constexpr const char* kPlant = "fixtures/plants/macs-nominal.toml";
constexpr const char* kController = "fixtures/controllers/bbmc-tuned.toml";

struct Hideout {
  std::function<void(RigAxisParameters&, double)> hide;
  bool alone = false;  // named, and nothing beside it
};

// The spring stays: its mode gets slower with the carriage.
void add_to_carriage(emulator::AxisParameters& p, double mass_kg) {
  const auto before = emulator::derive(p);
  const double r = before.metres_per_motor_rad;
  p.inertia_kg_m2 += mass_kg * r * r;
  const double mobility = 1 / (before.carriage_mass_kg + mass_kg) + r * r / p.rotor_inertia_kg_m2;
  const double w = std::sqrt(before.transmission_stiffness_N_per_m * mobility);
  p.elasticity.damping_ratio = before.transmission_damping_N_s_per_m * mobility / (2 * w);
  p.elasticity.resonance_Hz = w / 6.283185307179586;
}

const std::map<std::string, Hideout>& hideouts() {
  static const std::map<std::string, Hideout> kAll{
      {"viscous",
       {[](auto& a, double s) { a.plant.viscous_friction_Nm_s_per_rad *= 1 + 0.4 * s; }, true}},
      {"coulomb",
       {[](auto& a, double s) {
          a.plant.friction.breakaway_Nm += 0.3 * s * a.plant.coulomb_friction_Nm;
          a.plant.coulomb_friction_Nm *= 1 + 0.3 * s;
        },
        true}},
      {"added_mass", {[](auto& a, double s) { add_to_carriage(a.plant, 0.8 * s); }, true}},
      {"coulomb_asymmetry",
       {[](auto& a, double s) { a.plant.friction.options.asymmetry.coulomb = 0.2 * s; }, true}},
      {"viscous_asymmetry",
       {[](auto& a, double s) { a.plant.friction.options.asymmetry.viscous = 0.3 * s; }, true}},
      {"stribeck", {[](auto& a, double s) { a.plant.friction.breakaway_Nm *= 1 + 0.5 * s; }}},
      {"position_friction",
       {[](auto& a, double s) { a.plant.friction.position.friction_Nm[1] *= 1 - 0.6 * s; }}},
      {"position_force", {[](auto& a, double s) {
         for (int i = 0; i < 9; ++i) {
           (void)a.plant.disturbances.position_force.position_m.push_back(0.5 * i);
           (void)a.plant.disturbances.position_force.torque_Nm.push_back(0.7e-3 * s *
                                                                         (i % 2 == 0 ? 1 : -1));
         }
       }}},
      {"cable_spring", {[](auto& a, double s) {
         a.plant.disturbances.cable.stiffness_N_per_m = 1.0 * s;
         a.plant.disturbances.cable.reference_m = 1.5;
       }}},
      {"constant_bias", {[](auto& a, double s) { a.plant.disturbances.tilt_deg = 0.4 * s; }, true}},
      {"torque_ripple",
       {[](auto& a, double s) {
          a.plant.disturbances.torque_ripple.amplitude_Nm = 0.5e-3 * s;
          a.plant.disturbances.torque_ripple.periods_per_turn = 2;
        },
        true}},
      {"load_dependent_friction",
       {[](auto& a, double s) { a.plant.friction.options.load_ratio = 0.15 * s; }, true}},
      {"thermal_drift",
       {[](auto& a, double s) {
          a.plant.friction.options.warming.depth = std::min(0.9, 0.5 * s);
          a.plant.friction.options.warming.full_power_W = 0.3;
          a.plant.friction.options.warming.time_constant_s = 20;
        },
        true}},
      {"amplifier_gain",
       {[](auto& a, double s) { a.plant.amplifier_gain_A_per_V *= 1 - 0.1 * s; }}},
      {"chain_elasticity",
       {[](auto& a, double s) { a.plant.elasticity.resonance_Hz *= 1 - 0.12 * s; }, true}},
      {"backlash", {[](auto& a, double s) { a.plant.gear.backlash_deg = 0.5 * s; }}},
  };
  return kAll;
}

procedures::Conversation drawn_motions(std::uint64_t seed) {
  core::Random random(seed);
  procedures::Conversation talk{.name = fmt::format("diagnosis-{}", seed)};
  talk.start_m = {1.4, 0.34};
  talk.limit_s = 200;
  double at = 0;
  double elapsed = 0;
  while (elapsed < 50) {
    const double speed = 0.4 * std::pow(10, -1.6 * random.uniform());
    const double way =
        std::min(0.9, (0.15 + 1.6 * speed) * (0.6 + 0.4 * random.uniform())) * (at > 0 ? -1 : 1);
    const double rise = 0.12 + 0.5 * random.uniform();
    talk.steps.push_back(procedures::move(
        fmt::format("run -trapez y --distance {:.6f}m --speed {:.5f}m/s --acceleration {:.3f}s",
                    way, speed, rise)));
    at += way;
    elapsed += std::abs(way) / speed + rise;
  }
  return talk;
}

}  // namespace

std::vector<std::string> bench_effects(bool alone) {
  std::vector<std::string> names;
  for (const auto& [name, hideout] : hideouts()) {
    if (hideout.alone || !alone) {
      names.push_back(name);
    }
  }
  return names;
}

diagnose::Run bench_run(const BenchCase& one) {
  harness::SourceFiles sources;
  harness::RigFixture rig = harness::load_rig(kRig, sources);
  if (!one.effect.empty()) {
    hideouts().at(one.effect).hide(rig.parameters.axes[kY], one.strength);
  }
  const procedures::Machine machine(rig, harness::load_controller(kController, sources), one.seed);
  procedures::Conversation talk = drawn_motions(one.seed);
  auto steps = procedures::declare_position(talk, machine);
  talk.steps.insert(talk.steps.begin(), steps.begin(), steps.end());
  const identify::Recording log = machine.play(talk);
  if (!log.trouble.empty()) {
    throw std::runtime_error(log.trouble);
  }
  const double newton_per_pct = load_plant_model(kPlant, "y").model.newton_per_duty_pct;
  diagnose::Run run;
  run.name = "bench";
  run.period_s = log.period_s;
  const auto n = static_cast<Eigen::Index>(log.rows());
  run.position_m.resize(n);
  run.input_N.resize(n);
  run.reference_m.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    run.position_m[k] = log.position_m(kY, row);
    run.input_N[k] = newton_per_pct * log.axes[kY].duty_pct[row];
    run.reference_m[k] = log.axes[kY].reference_m[row];
  }
  run.missing.assign(log.rows(), 0);
  run.resolution_m = log.metres_per_count[kY];
  run.input_step_N = 0.1 * newton_per_pct;
  return run;
}

diagnose::Diagnosis diagnose_bench(const BenchCase& one) {
  diagnose::Request request;
  request.model = load_plant_model(kPlant, "y").model;
  request.runs = {bench_run(one)};
  return diagnose::diagnose(request);
}

}  // namespace towbench::tests
