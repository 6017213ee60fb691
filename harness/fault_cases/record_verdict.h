// What a run folder must show when the host that wrote it had no room left, or was killed: no less
// than what was written before, and never a pass.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/checks/check.h"
#include "harness/fault_cases/case_record.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

// What is known of how the folder came to be.
struct RecordFacts {
  bool writes_succeeded = true;
  bool host_was_killed = false;
  Verdict ordinary = Verdict::kPass;  // of the judge who knows nothing of the fault
};

// `run` is the same run, whole, in memory. A check for each demand that applies; none when the plan
// does not strike the record.
[[nodiscard]] std::vector<Check> judge_record(const std::filesystem::path& folder,
                                              const HostSchedule& host, const CaseRecord& run,
                                              const RecordFacts& facts);

// The folder was written by a second run of the same bits; were it another run, its verdict would
// be about something else. What was cut short is compared as far as it goes.
[[nodiscard]] Check recorded_run_check(const std::filesystem::path& folder, const CaseRecord& run,
                                       bool log_may_be_short, bool truth_may_be_short);

}  // namespace towbench::harness
