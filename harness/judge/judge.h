// Judges a finished run from its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/judge/budget_checks.h"
#include "harness/lockstep/run_outcome.h"
#include "harness/requirements/judged_requirement.h"

namespace towbench::harness {

struct Judgement {
  Verdict verdict = Verdict::kInvalid;
  std::string judged;  // what happened in a run with faults, in words; else empty
  std::vector<Check> checks;
  std::vector<ResolvedWindow> windows;
  std::vector<Measurement> measurements;
  // Their checks stand among `checks`; these have the margins over time, at the times of log.csv.
  std::vector<JudgedRequirement> requirements;
  std::vector<double> time_s;
};

// Reads the record; never throws: a record that cannot be read is INVALID and says why.
[[nodiscard]] Judgement judge(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                              const RunOutcome& outcome);

// Where the rig's axes end, for metrics and drawings.
[[nodiscard]] core::PerAxis<AxisLimits> limits_of(const emulator::RigParameters& rig);

}  // namespace towbench::harness
