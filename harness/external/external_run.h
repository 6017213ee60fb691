// An experiment whose controller is a program that the bench did not write: the greeting, the run,
// faults of machine and link beside a run without them, and what is judged of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/external/external_controller.h"
#include "harness/fault_cases/reference_run.h"
#include "harness/judge/judge.h"
#include "harness/link/link_faults.h"
#include "harness/lockstep/script_loop.h"

namespace towbench::harness {

class ExternalRun {
 public:
  // With faults in the experiment the controller runs once without them, here
  // unless `reference` is that run. `watchers` outlives this. Throws FixtureError for a fault that
  // cannot be here, or where the run without faults does not end well.
  ExternalRun(const ExperimentFixture& fixture, const ExternalController& controller,
              std::uint64_t seed, const LoopWatchers& watchers,
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

 private:
  ExternalController controller_;
  std::uint64_t seed_;
  const LoopWatchers& watchers_;
  ExperimentFixture fixture_;
  std::shared_ptr<const ReferenceRun> reference_;
  std::vector<LinkFault> link_faults_;
  std::vector<std::string> refused_;  // of the run's messages, in words
};

// Of an experiment without faults. How it ended is in its record's outcome. Throws FixtureError for
// an experiment that states no reference.
[[nodiscard]] std::shared_ptr<const ReferenceRun> run_external_reference(
    const ExperimentFixture& sound, const ExternalController& controller, std::uint64_t seed,
    const LoopWatchers& watchers);

}  // namespace towbench::harness
