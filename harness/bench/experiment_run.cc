#include "harness/bench/experiment_run.h"

#include <memory>

#include "harness/bench/emulator_process.h"
#include "harness/bench/in_process_plant.h"
#include "harness/bench/linked_plant.h"
#include "harness/faults/case_link.h"
#include "harness/faults/faulted_experiment.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/plant_recorder.h"
#include "harness/record/result_files.h"
#include "harness/record/run_folder.h"

namespace towbench::harness {
namespace {

class Run {
 public:
  Run(const ExperimentFixture& fixture, const RunOptions& options)
      : faults_(faults_of(fixture, options)),
        fixture_(faults_ ? faults_->fixture() : fixture),
        options_(options) {
    identity_.carrier = options.carrier == Carrier::kLocal ? "local" : "in-process";
    identity_.seed = seed_of(fixture, options);
    identity_.started_utc = utc_now();
    constexpr std::size_t kShortHash = 8;
    folder_ = create_run_folder(options.out, fixture.experiment.name,
                                hash_text(fixture.hash).substr(0, kShortHash));
    identity_.experiment_copy = copy_inputs(fixture.sources, folder_);
    write_started(folder_, fixture, identity_);
  }

  RunResult run() {
    auto outcome = options_.carrier == Carrier::kLocal ? run_with_child() : run_in_process();
    outcome.control_period_ns = fixture_.controller.configuration.control_period_ns();
    outcome.complete = outcome.complete || (faults_ && faults_->kills_plant());
    RunResult result;
    result.folder = folder_;
    result.complete = outcome.complete;
    result.reason = outcome.reason;
    if (outcome.complete) {
      merge_events(folder_);
      result.judgement = judge(folder_, fixture_, outcome);
      if (faults_) {
        faults_->judge_into(folder_, result.judgement);
      }
      write_judged(folder_, fixture_, identity_, outcome, result.judgement);
      result.exit_code = exit_code_of(result.judgement.verdict);
    } else {
      write_incomplete(folder_, fixture_, identity_, outcome);
    }
    result.outcome = outcome;
    return result;
  }

 private:
  static std::uint64_t seed_of(const ExperimentFixture& fixture, const RunOptions& options) {
    return options.seed.value_or(fixture.experiment.seed);
  }
  static std::unique_ptr<FaultedExperiment> faults_of(const ExperimentFixture& fixture,
                                                      const RunOptions& options) {
    return fixture.experiment.faults.empty()
               ? nullptr
               : std::make_unique<FaultedExperiment>(fixture, seed_of(fixture, options));
  }

  RunOutcome run_in_process() {
    PlantRecorder plant_recorder(folder_);
    InProcessPlant plant(fixture_.rig.parameters, identity_.seed, fixture_.experiment.events,
                         plant_recorder);
    auto outcome = play_against(plant);
    plant_recorder.flush();
    outcome.writes_succeeded = outcome.writes_succeeded && plant_recorder.good();
    return outcome;
  }

  RunOutcome run_with_child() {
    EmulatorProcess child(options_.program,
                          {(folder_ / identity_.experiment_copy).string(), "--seed",
                           std::to_string(identity_.seed), "--out", folder_.string()});
    LinkedPlant plant(child.stream());
    auto outcome = play_against(plant);
    if (const auto trouble = child.join(); !trouble.empty()) {
      outcome.reason += (outcome.reason.empty() ? "" : "; ") + trouble;
      outcome.complete = false;
    }
    return outcome;
  }

  RunOutcome play_against(PlantEnd& plant) {
    ControllerRecorder recorder(folder_);
    if (!faults_) {
      LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, plant, &recorder);
      return play(fixture_.experiment, bench, recorder, options_.watchers);
    }
    CaseRecord crossed;  // what it notes is of no use here: the judge makes its own
    CaseLink link(plant, faults_->injection().link, crossed);
    LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, link, &recorder);
    bench.run_on(faults_->injection().host);
    return play(fixture_.experiment, bench, recorder, options_.watchers);
  }

  std::unique_ptr<FaultedExperiment> faults_;  // null: a sound machine
  const ExperimentFixture& fixture_;
  const RunOptions& options_;
  RunIdentity identity_;
  std::filesystem::path folder_;
};

}  // namespace

RunResult run_experiment(const ExperimentFixture& fixture, const RunOptions& options) {
  return Run(fixture, options).run();
}

}  // namespace towbench::harness
