// An experiment with faults on its way to a run folder: what they become is added to its events and
// its machine, and the requirements are judged beside its budgets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/record_verdict.h"
#include "harness/fault_plan/carrier_fit.h"
#include "harness/judge/judge.h"

namespace towbench::harness {

// Adds faults that the experiment's file does not hold, and notes them in its text as [[fault]]
// tables, so that the run folder's copy holds them. Its budgets, which speak of the sound machine,
// do not apply any more.
void add_faults(ExperimentFixture& fixture, const FaultPlan& plan);

class FaultedExperiment {
 public:
  // Runs the reference run and finds when everything begins. Throws FixtureError, also for a fault
  // that the carrier cannot have.
  FaultedExperiment(const ExperimentFixture& fixture, std::uint64_t seed,
                    CarrierKind carrier = CarrierKind::kInProcess);

  // What is to be run: without expectations, with the faults' events, on the machine as built.
  [[nodiscard]] const ExperimentFixture& fixture() const noexcept { return faulted_; }
  [[nodiscard]] const Injection& injection() const noexcept { return prepared_.injection; }
  // When each fault of the plan begins.
  [[nodiscard]] const std::vector<core::Nanoseconds>& onsets_ns() const noexcept {
    return prepared_.onsets_ns;
  }
  // A run that ends because the two sides do not hear each other any more ends as it should.
  [[nodiscard]] bool may_end_run() const noexcept;
  // The controller's process does not live to the end of the run.
  [[nodiscard]] bool kills_host() const noexcept;

  // Judges the same run in memory, that the folder holds that run, and what a struck record must
  // show.
  CaseVerdict judge_into(const std::filesystem::path& folder, RecordFacts facts,
                         Judgement& judgement) const;

 private:
  ExperimentFixture plain_;
  ExperimentFixture faulted_;
  std::uint64_t seed_;
  std::unique_ptr<CaseRecord> reference_;
  PreparedPlan prepared_;
};

}  // namespace towbench::harness
