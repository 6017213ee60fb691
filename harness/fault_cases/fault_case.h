// A plan of faults carried out on an experiment, and judged: did each fault take effect, and did
// the controller do what it must.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/case_figures.h"
#include "harness/fault_cases/case_record.h"
#include "harness/fault_plan/fault.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

// When each fault of a plan begins; built-in ones at 0. Throws FixtureError when a trigger's
// condition is never met in the fault-free run, or a built-in one leaves no machine.
struct PreparedPlan {
  FaultPlan plan{};
  std::vector<core::Nanoseconds> onsets_ns{};
  emulator::RigParameters built{};
  Injection injection{};
};
[[nodiscard]] PreparedPlan prepare(const FaultPlan& plan, const ExperimentFixture& fixture,
                                   const CaseRecord& reference, bool over_can = false);
// With the beginnings known already (a run folder's, a child process's).
[[nodiscard]] PreparedPlan prepare_at(const FaultPlan& plan,
                                      const std::vector<core::Nanoseconds>& onsets_ns,
                                      const ExperimentFixture& fixture, const CaseRecord& reference,
                                      bool over_can = false);

// All that the requirements look at.
struct CaseEvidence {
  const ExperimentFixture& fixture;
  const PreparedPlan& prepared;
  const CaseRecord& reference;  // no fault
  const CaseRecord& run;
  core::Nanoseconds cause_ns = 0;
  std::uint64_t seed = 1;
};

struct CaseVerdict {
  bool fired = false;     // every fault of the plan
  bool detected = false;  // a fault was latched that the reference run does not have
  bool handled = false;   // every requirement held
  std::vector<Check> checks;
  CaseFigures figures;
  [[nodiscard]] Verdict verdict() const noexcept { return worst_of(checks); }
};

// The fault-free run of an experiment, without its expectations.
[[nodiscard]] std::unique_ptr<CaseRecord> run_reference(const ExperimentFixture& plain,
                                                        std::uint64_t seed, bool over_can = false);

// Judges a run that was made as prepared.
[[nodiscard]] CaseVerdict judge_run(const ExperimentFixture& plain, const PreparedPlan& prepared,
                                    const CaseRecord& reference, std::uint64_t seed,
                                    const CaseRecord& run);

// Runs and judges. Faults that strike the record are left out: there is none in memory. `plain` is
// without expectations; `run_out` takes the record when it is not null.
[[nodiscard]] CaseVerdict judge_case(const ExperimentFixture& plain, const PreparedPlan& prepared,
                                     const CaseRecord& reference, std::uint64_t seed,
                                     std::unique_ptr<CaseRecord>* run_out = nullptr);

}  // namespace towbench::harness
