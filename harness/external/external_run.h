// An experiment whose controller is a program that the bench did not write: the greeting, the run,
// faults of machine and link beside a run without them, and what is judged of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/external/external_controller.h"
#include "harness/external/external_timing.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fault_cases/reference_run.h"
#include "harness/judge/judge.h"
#include "harness/link/link_faults.h"
#include "harness/lockstep/operator.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/run_tap.h"

namespace towbench::harness {

// How an experiment is played.
struct ExternalPlay {
  ExternalController controller;
  std::uint64_t seed = 0;
  const LoopWatchers& watchers;  // outlives the run
  bool by_wall_clock = false;    // not with faults
  RunTap* tap = nullptr;         // may be null, as may the operator; both outlive the run
  Operator* run_operator = nullptr;
};

class ExternalRun {
 public:
  // With faults in the experiment the controller runs once without them, here
  // unless `reference` is that run, and once without each of several. Throws FixtureError for a
  // fault that cannot be here, or where the run without faults does not end well.
  ExternalRun(const ExperimentFixture& fixture, const ExternalPlay& how,
              std::shared_ptr<const ReferenceRun> reference = nullptr);

  // What is to be run: with the faults as events and as built.
  [[nodiscard]] const ExperimentFixture& fixture() const noexcept { return fixture_; }
  // Writes the record of both sides, and what the controller's process printed to controller.txt.
  [[nodiscard]] RunOutcome play(const std::filesystem::path& folder);
  // Before the judge: the record without faults, in a folder of its own below.
  void keep_reference(const std::filesystem::path& folder) const;
  // Adds what every external controller must keep, and drops what speaks of BBMC.
  void judge_into(const std::filesystem::path& folder, const RunOutcome& outcome,
                  Judgement& judgement) const;
  // How punctual a run by the wall clock was, in words; adds to the verdict.
  [[nodiscard]] std::string judge_timing_into(const std::filesystem::path& folder,
                                              Judgement& judgement) const;
  // Faults that were made by hand are judged beside a run without them too.
  void take_over(const ExperimentFixture& driven);

 private:
  void prepare_faults();

  ExternalPlay how_;
  ExperimentFixture fixture_;
  std::shared_ptr<const ReferenceRun> reference_;
  std::vector<RunWithout> without_;  // each of several faults
  std::vector<LinkFault> link_faults_;
  std::vector<std::string> refused_;  // of the run's messages, in words
  std::unique_ptr<ExternalTiming> timing_;
};

// Of an experiment without faults. How it ended is in its record's outcome. Throws FixtureError for
// an experiment that states no reference.
[[nodiscard]] std::shared_ptr<const ReferenceRun> run_external_reference(
    const ExperimentFixture& sound, const ExternalController& controller, std::uint64_t seed,
    const LoopWatchers& watchers);

}  // namespace towbench::harness
