#include "study/results/identification_set.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/random.h"
#include "study/procedures/kept_outcome.h"
#include "study/procedures/sequence.h"
#include "study/results/worker_processes.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;

std::filesystem::path folder_of(const IdentificationSet& set, std::uint64_t machine,
                                std::uint64_t seed) {
  return set.out / fmt::format("machine-{}", machine) / fmt::format("seed-{}", seed);
}

std::string fingerprint_of(const IdentificationSet& set, const harness::RigFixture& rig,
                           std::uint64_t machine, std::uint64_t seed) {
  return fmt::format("{:016x}-{:016x}-{}-{}-{}{}", rig.hash, set.controller.hash, machine,
                     set.spread, seed,
                     set.structures.empty() ? std::string_view() : set.structures[machine].name);
}

DrawnRig rig_of(const IdentificationSet& set, std::uint64_t machine, std::uint64_t seed) {
  return set.structures.empty()
             ? drawn_rig(set.rig, machine, set.spread, nullptr)
             : drawn_rig(set.rig, (seed - 1) % set.machines, set.spread, &set.structures[machine]);
}

std::uint64_t rows_of(const IdentificationSet& set) {
  return set.structures.empty() ? set.machines : set.structures.size();
}

nlohmann::json to_json(const std::vector<Recovery>& recoveries,
                       const procedures::SequenceResult& result) {
  nlohmann::json json{{"recoveries", nlohmann::json::array()},
                      {"not_done", nlohmann::json::array()},
                      {"withheld", nlohmann::json::array()}};
  for (const auto& each : recoveries) {
    json["recoveries"].push_back(
        {{"estimate", identify::to_json({each.estimate})}, {"truth", each.truth}});
  }
  for (const auto& step : result.steps) {
    for (const auto& each : step.outcome.withheld) {
      json["withheld"].push_back(
          fmt::format("{} {}: {}", each.quantity, core::name_of(step.axis), each.no_interval));
    }
    if (step.outcome.status != ProcedureOutcome::Status::kDone) {
      json["not_done"].push_back(
          fmt::format("{} {}: {}", step.id, core::name_of(step.axis), step.outcome.reason));
    }
  }
  return json;
}

// One machine, one seed, in a process of its own.
void identify_one(const IdentificationSet& set, std::uint64_t number, std::uint64_t seed) {
  const auto drawn = rig_of(set, number, seed);
  const auto& rig = drawn.truth;
  const auto machine = drawn.machine(set.controller, seed, {.stop = set.stop, .progress = {}});
  const auto folder = folder_of(set, number, seed);
  const auto fingerprint = fingerprint_of(set, rig, number, seed);
  const auto result = procedures::run_sequence(machine, procedures::identification_procedures(),
                                               {.only = {},
                                                .axes = set.axes,
                                                .settings = set.settings,
                                                .out = folder,
                                                .fingerprint = fingerprint,
                                                .resume = true,
                                                .progress = {},
                                                .stop = set.stop});
  if (set.stop != nullptr && set.stop->load()) {
    return;
  }
  procedures::keep_outcome(folder / "judged.json", procedures::program_fingerprint() + fingerprint,
                           to_json(judge_recovery(rig.parameters, result.estimates), result));
}

SetRun read_run(const IdentificationSet& set, std::uint64_t machine, std::uint64_t seed) {
  SetRun run{.machine = machine, .seed = seed};
  const auto rig = rig_of(set, machine, seed).truth;
  const auto kept = procedures::kept_outcome(
      folder_of(set, machine, seed) / "judged.json",
      procedures::program_fingerprint() + fingerprint_of(set, rig, machine, seed));
  if (!kept) {
    return run;
  }
  run.done = true;
  kept->at("not_done").get_to(run.not_done);
  kept->at("withheld").get_to(run.withheld);
  for (const auto& each : kept->at("recoveries")) {
    const auto judged =
        judge_recovery(rig.parameters, identify::estimates_from_json(each.at("estimate")));
    run.recoveries.insert(run.recoveries.end(), judged.begin(), judged.end());
  }
  return run;
}

}  // namespace

harness::RigFixture drawn_machine(harness::RigFixture rig, std::uint64_t number, double spread) {
  if (number == 0) {
    return rig;
  }
  core::Random random(0x6d616368 + number);
  const auto factor = [&] { return 1 - spread + 2 * spread * random.uniform(); };
  for (const auto axis : core::kPlanarAxes) {
    auto& plant = rig.parameters.axes[axis].plant;
    // The rotor itself is well known; what is drawn is what it carries.
    plant.inertia_kg_m2 =
        plant.rotor_inertia_kg_m2 + (plant.inertia_kg_m2 - plant.rotor_inertia_kg_m2) * factor();
    plant.viscous_friction_Nm_s_per_rad *= factor();
    const double dry = factor();  // break-away stays above sliding friction
    plant.coulomb_friction_Nm *= dry;
    plant.friction.breakaway_Nm *= dry;
    plant.torque_constant_Nm_per_A *= factor();
    plant.amplifier_gain_A_per_V *= factor();
    plant.elasticity.resonance_Hz *= factor();
    plant.elasticity.damping_ratio *= factor();
  }
  return rig;
}

procedures::Machine DrawnRig::machine(const harness::ControllerFixture& controller,
                                      std::uint64_t seed, harness::LoopWatchers watchers) const {
  return procedures::Machine(truth, controller, seed, std::move(watchers))
      .documented_by(documents.parameters);
}

DrawnRig drawn_rig(const harness::RigFixture& rig, std::uint64_t number, double spread,
                   const ForeignStructure* structure) {
  DrawnRig drawn{.documents = drawn_machine(rig, number, spread), .truth = {}};
  drawn.truth = drawn.documents;
  if (structure != nullptr) {
    drawn.truth.parameters = built(drawn.truth.parameters, *structure);
    drawn.truth.name += fmt::format(" ({})", structure->name);
  }
  return drawn;
}

std::vector<SetRun> run_set(const IdentificationSet& set) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> wanted;
  std::size_t there = 0;
  const auto machines = rows_of(set);
  const auto all = static_cast<std::size_t>(machines * set.seeds);
  // Seed after seed of all machines: a set that is stopped is a smaller one of all of them.
  for (std::uint64_t seed = 1; seed <= set.seeds; ++seed) {
    for (std::uint64_t machine = 0; machine < machines; ++machine) {
      if (read_run(set, machine, seed).done) {
        ++there;
      } else {
        wanted.emplace_back(machine, seed);
      }
    }
  }
  const auto progress = [&](std::size_t ended) {
    if (set.progress) {
      set.progress(there + ended, all);
    }
  };
  run_in_processes(wanted.size(), {set.workers, set.stop, progress}, [&](std::size_t number) {
    const auto [machine, seed] = wanted[number];
    try {
      identify_one(set, machine, seed);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("machine {} seed {}: {}", machine, seed, error.what()));
    }
  });
  std::vector<SetRun> runs;
  for (std::uint64_t machine = 0; machine < machines; ++machine) {
    for (std::uint64_t seed = 1; seed <= set.seeds; ++seed) {
      runs.push_back(read_run(set, machine, seed));
    }
  }
  return runs;
}

}  // namespace towbench::study
