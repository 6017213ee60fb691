// Whose faults a campaign tries: BBMC, or a controller that the bench did not write.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/external/external_controller.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/reference_run.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

struct CandidateController {
  std::optional<ExternalController> external{};
  std::filesystem::path firmware{};
  std::string text{};  // as --controller takes it; empty: BBMC

  [[nodiscard]] bool is_bbmc() const noexcept { return text.empty(); }
};

// The controller of the runs that these options are for.
void choose_candidate(const CandidateController& controller, RunOptions& options);

// Its run of a motion without faults; how it ended is in the record's outcome. Throws FixtureError
// for a motion that it cannot be given. Not for BBMC.
[[nodiscard]] std::shared_ptr<const ReferenceRun> reference_run_of(
    const CandidateController& controller, const ExperimentFixture& motion);

struct CandidateRun {
  std::filesystem::path folder{};
  std::vector<Check> checks{};
  bool complete = false;
  std::string reason{};  // why it is not complete
  bool fired = false;    // each fault took effect
};

// Runs a motion with the faults that it holds, or without any, into the folder `out`. Not for BBMC.
// `reference` is its run without them. Throws FixtureError for a plan that cannot be carried out.
[[nodiscard]] CandidateRun run_candidate(const CandidateController& controller,
                                         const ExperimentFixture& motion,
                                         const std::shared_ptr<const ReferenceRun>& reference,
                                         const std::filesystem::path& out);

// The same run in a temporary folder, as a case of a campaign.
[[nodiscard]] CaseVerdict judge_candidate(const CandidateController& controller,
                                          const ExperimentFixture& motion,
                                          const std::shared_ptr<const ReferenceRun>& reference);

// What a case shows whose run did not come to its end.
[[nodiscard]] inline Check run_not_complete(const std::string& reason) {
  return invalid_check("run_complete", "the run came to its end", reason);
}

// What it is, as far as that can be known: an image's bytes; a command and every file that it
// names.
void add_identity(const CandidateController& controller, CanonicalHash& hash);

}  // namespace towbench::harness
