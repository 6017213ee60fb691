// What is to be run, decided before anything starts: the kind of run, what comes between controller
// and plant, the experiment as it will be run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "harness/experiment/experiment_fixture.h"
#include "harness/external/external_run.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/realtime/realtime_budget.h"
#include "harness/record/result_files.h"
#include "harness/run/board_run.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

enum class RunKind : std::uint8_t {
  kInProcess,
  kBoard,         // an image on the virtual board, in this process
  kExternal,      // a controller that the bench did not write; the plant in this process
  kChildProcess,  // the plant in a process of its own
  kKilledHost,    // the same, and the controller's process does not live to the end
};

enum class Disturbance : std::uint8_t {
  kNone,
  kByHand,   // a person may disturb the link
  kPlanned,  // the faults of a plan
};

struct RunPlan {
  RunPlan(const ExperimentFixture& experiment, const RunOptions& how)
      : options(how), given(experiment), fixture(experiment) {}

  const RunOptions& options;  // outlives this
  RunKind kind = RunKind::kInProcess;
  Disturbance disturbance = Disturbance::kNone;
  std::uint64_t seed = 0;
  ExperimentFixture given;                        // before anything was planned or done
  std::unique_ptr<FaultedExperiment> faults;      // of Disturbance::kPlanned
  std::unique_ptr<BoardRun> board;                // of RunKind::kBoard
  std::unique_ptr<ExternalRun> external;          // of RunKind::kExternal
  std::optional<RealtimeBudget> realtime_budget;  // of BBMC by the wall clock
  ExperimentFixture fixture;                      // with the faults as events and as built
  std::filesystem::path folder;                   // from begin_record() on, as is `identity`
  RunIdentity identity;

  [[nodiscard]] bool has_faults() const noexcept { return disturbance == Disturbance::kPlanned; }
  // A run that ends because the two sides do not hear each other any more ends as it should.
  [[nodiscard]] bool may_end_early() const noexcept;
  // From here on the experiment is the one that was driven, with what was broken by hand.
  void take_over(const InteractiveOperator& run_operator);
};

// Runs the reference that faults are judged beside. Throws FixtureError for what cannot be run so.
[[nodiscard]] RunPlan plan_run(const ExperimentFixture& fixture, const RunOptions& options);

// Creates the run folder: inputs, and a first result that says incomplete.
void begin_record(RunPlan& plan);

}  // namespace towbench::harness
