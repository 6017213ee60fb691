// Faults of the machine under a controller that is not BBMC: an image on the virtual board, or a
// program of its own. When they begin is found in the run of the same controller without them, and
// what they have changed is read from both records.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/reference_run.h"

namespace towbench::harness {

// Which faults the bench can make for a controller that is not BBMC: those of the machine for an
// image on the virtual board, and those of the link as well for a program in its own process.
enum class FaultReach : std::uint8_t { kMachine, kMachineAndLink };

// Throws FixtureError for another fault, such as one of the host, or one that ends the link.
void refuse_faults_beyond(const FaultPlan& faults, FaultReach reach);
[[nodiscard]] bool is_within(const Fault& fault, FaultReach reach);

// The plan of a sound experiment, with its moments. Throws FixtureError for one that the reference
// run does not meet, or that only a controller with a record of its own would tell.
[[nodiscard]] PreparedPlan prepare_without_bbmc(const ExperimentFixture& sound,
                                                const CaseRecord& reference);
// As events and as built.
[[nodiscard]] ExperimentFixture with_faults(const ExperimentFixture& sound,
                                            const PreparedPlan& prepared);
// A welded contact shows only when somebody presses it: then the sound one, pressed too, is what
// the fault is judged beside. None when no contact is welded.
[[nodiscard]] std::optional<ExperimentFixture> pressed_where_welded(const ExperimentFixture& sound,
                                                                    const PreparedPlan& prepared);

// What is run without one of several faults, everything else being equal: each of them must take
// effect. Empty for a single one, which is judged beside the run without faults.
struct LeftOut {
  std::string fault;  // in words
  ExperimentFixture fixture;
  std::vector<LinkFault> link;
};
[[nodiscard]] std::vector<LeftOut> each_left_out(const ExperimentFixture& sound,
                                                 const PreparedPlan& prepared,
                                                 const CaseRecord& reference);

struct RunWithout {
  std::string fault;  // in words
  std::shared_ptr<const ReferenceRun> run;
};

// From the records of the runs: whether each fault changed anything and whether anything moves
// without them (INVALID where not), whether the carriage met a hard end that it did not meet
// without any, and ANY-8: whether an axis is at its limit for longer. INVALID when a record cannot
// be read.
[[nodiscard]] std::vector<Check> judge_beside_reference(const std::filesystem::path& folder,
                                                        const std::filesystem::path& reference,
                                                        const std::vector<RunWithout>& without);

}  // namespace towbench::harness
