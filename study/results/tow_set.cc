#include "study/results/tow_set.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/random.h"
#include "study/procedures/kept_outcome.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/recovery/tow/tow_recovery.h"
#include "study/results/worker_processes.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;

std::filesystem::path file_of(const TowSet& set, std::uint64_t machine, std::uint64_t seed) {
  return set.out / fmt::format("machine-{}", machine) / fmt::format("seed-{}.json", seed);
}

std::string fingerprint_of(const TowSet& set, std::uint64_t machine, std::uint64_t seed) {
  auto text = fmt::format("{}-{:016x}-{:016x}-{}-{}", procedures::program_fingerprint(),
                          set.rig.hash, set.controller.hash, machine, seed);
  for (const auto& each : set.only) {
    text += "-" + each;
  }
  return text;
}

bool is_wanted(const TowSet& set, std::string_view id) {
  return set.only.empty() || std::find(set.only.begin(), set.only.end(), id) != set.only.end();
}

nlohmann::json to_json(const Recovery& each) {
  return {{"estimate", identify::to_json({each.estimate})},
          {"truth", each.truth},
          {"error_pct", each.error_pct},
          {"width_pct", each.width_pct},
          {"covered", each.covered}};
}

Recovery from_json(const nlohmann::json& json) {
  Recovery each;
  each.estimate = identify::estimates_from_json(json.at("estimate")).at(0);
  json.at("truth").get_to(each.truth);
  json.at("error_pct").get_to(each.error_pct);
  json.at("width_pct").get_to(each.width_pct);
  json.at("covered").get_to(each.covered);
  return each;
}

// One machine, one seed, all experiments. Each machine has noise of its own: with the same on all,
// more machines would say no more.
void tow_one(const TowSet& set, std::uint64_t machine, std::uint64_t seed) {
  constexpr std::uint64_t kMostSeeds = 10'000;  // of a set
  const procedures::TowLoads loads(drawn_for_towing(set.rig, machine), set.controller,
                                   machine * kMostSeeds + seed, set.rigs,
                                   {.stop = set.stop, .progress = {}});
  nlohmann::json kept{{"recoveries", nlohmann::json::array()},
                      {"not_done", nlohmann::json::array()}};
  for (const auto& procedure : procedures::tow_procedures()) {
    const std::string id(procedure->id());
    if (!is_wanted(set, id)) {
      continue;
    }
    auto settings = set.settings / (id + ".toml");
    if (!std::filesystem::exists(settings)) {
      settings.clear();
    }
    const auto outcome = procedure->run({.loads = loads, .settings = settings, .progress = {}});
    if (outcome.status != ProcedureOutcome::Status::kDone) {
      kept["not_done"].push_back(id + ": " + outcome.reason);
    }
    for (const auto& each : judge_tow(loads.truth(procedure->load()), outcome)) {
      kept["recoveries"].push_back(to_json(each));
    }
  }
  if (set.stop == nullptr || !set.stop->load()) {
    procedures::keep_outcome(file_of(set, machine, seed), fingerprint_of(set, machine, seed), kept);
  }
}

TowSetRun read_run(const TowSet& set, std::uint64_t machine, std::uint64_t seed) {
  TowSetRun run{.machine = machine, .seed = seed};
  const auto kept =
      procedures::kept_outcome(file_of(set, machine, seed), fingerprint_of(set, machine, seed));
  if (!kept) {
    return run;
  }
  run.done = true;
  kept->at("not_done").get_to(run.not_done);
  for (const auto& each : kept->at("recoveries")) {
    run.recoveries.push_back(from_json(each));
  }
  return run;
}

}  // namespace

harness::RigFixture drawn_for_towing(harness::RigFixture rig, std::uint64_t number) {
  if (number == 0) {
    return rig;
  }
  core::Random random(0x746f77 + number);
  const auto factor = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  for (const auto which : core::kPlanarAxes) {
    auto& plant = rig.parameters.axes[which].plant;
    plant.inertia_kg_m2 *= factor(0.9, 1.1);
    plant.viscous_friction_Nm_s_per_rad *= factor(0.7, 1.1);
    const double dry = factor(0.7, 1.1);
    plant.coulomb_friction_Nm *= dry;
    plant.friction.breakaway_Nm *= dry;
    plant.torque_constant_Nm_per_A *= factor(0.9, 1.0);
    plant.amplifier_gain_A_per_V *= factor(0.9, 1.1);
    plant.elasticity.resonance_Hz *= factor(0.9, 1.2);
  }
  return rig;
}

std::vector<TowSetRun> run_tow_set(const TowSet& set) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> wanted;
  // Seed after seed of all machines: a set that is stopped is a smaller one of all of them.
  for (std::uint64_t seed = 1; seed <= set.seeds; ++seed) {
    for (std::uint64_t machine = 0; machine < set.machines; ++machine) {
      if (!read_run(set, machine, seed).done) {
        wanted.emplace_back(machine, seed);
      }
    }
  }
  const auto all = static_cast<std::size_t>(set.machines * set.seeds);
  const auto progress = [&](std::size_t ended) {
    if (set.progress) {
      set.progress(all - wanted.size() + ended, all);
    }
  };
  run_in_processes(wanted.size(), {set.workers, set.stop, progress}, [&](std::size_t number) {
    tow_one(set, wanted[number].first, wanted[number].second);
  });
  std::vector<TowSetRun> runs;
  for (std::uint64_t machine = 0; machine < set.machines; ++machine) {
    for (std::uint64_t seed = 1; seed <= set.seeds; ++seed) {
      runs.push_back(read_run(set, machine, seed));
    }
  }
  return runs;
}

}  // namespace towbench::study
