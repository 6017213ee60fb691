// Faults of the machine under a controller that is not BBMC: an image on the virtual board, or a
// program of its own. When they begin is found in the run of the same controller without them, and
// what they have changed is read from both records.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/fault_case.h"

namespace towbench::harness {

// Throws FixtureError for a fault that needs more than the machine: a link, or a host.
void refuse_faults_beyond_machine(const FaultPlan& faults);

// The plan of a sound experiment, with its moments. Throws FixtureError for one that the reference
// run does not meet, or that only a controller with a record of its own would tell.
[[nodiscard]] PreparedPlan prepare_without_events(const ExperimentFixture& sound,
                                                  const CaseRecord& reference);
// As events and as built.
[[nodiscard]] ExperimentFixture with_faults(const ExperimentFixture& sound,
                                            const PreparedPlan& prepared);
// A welded contact shows only when somebody presses it: then the sound one, pressed too, is what
// the fault is judged beside. None when no contact is welded.
[[nodiscard]] std::optional<ExperimentFixture> pressed_where_welded(const ExperimentFixture& sound,
                                                                    const PreparedPlan& prepared);

// From the records of both runs: whether anything differs (INVALID when nothing does), and whether
// the carriage met a hard end that it did not meet without.
[[nodiscard]] std::vector<Check> judge_beside_reference(const std::filesystem::path& folder,
                                                        const std::filesystem::path& reference);

}  // namespace towbench::harness
