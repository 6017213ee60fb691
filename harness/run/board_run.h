// A run whose controller is an image on the virtual board, beside what all runs share: the board's
// own faults and budgets, faults of the machine, a person at the console.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "harness/board_bench/board_truth.h"
#include "harness/board_bench/reference_board.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/link/plant_end.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

class BoardRun {
 public:
  // The options outlive this. Throws FixtureError for a fault that cannot be here.
  BoardRun(const ExperimentFixture& fixture, const RunOptions& options, std::uint64_t seed);

  // What is to be run: with the faults of the machine as events and as built.
  [[nodiscard]] const ExperimentFixture& fixture() const noexcept { return fixture_; }
  [[nodiscard]] RunOutcome play(const std::filesystem::path& folder, PlantEnd& plant,
                                BoardTruth& truth);
  // Before the judge: the record of the same image without the machine's faults, in a folder of its
  // own below.
  void keep_reference(const std::filesystem::path& folder) const;
  // Adds the verdicts on faults and budgets, and drops what speaks of a sound board or machine.
  void judge_into(const std::filesystem::path& folder, const RunOutcome& outcome,
                  Judgement& judgement) const;

 private:
  const RunOptions& options_;
  std::shared_ptr<const ReferenceRun> reference_;  // of a machine with faults
  std::vector<RunWithout> without_;                // each of several faults
  ExperimentFixture fixture_;
  std::vector<Check> checks_;
};

// Throws FixtureError when an experiment for the board is to run without it.
void refuse_board_plan(const ExperimentFixture& fixture);

}  // namespace towbench::harness
