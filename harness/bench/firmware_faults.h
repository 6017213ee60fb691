// Faults of the machine under an image on the virtual board. The image is a stranger: there is no
// twin of it in memory, so that moments are given by time alone, and what a fault has changed is
// read from the record of the same image's run without it.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "harness/judge/check.h"

namespace towbench::harness {

// The experiment with its faults as events and as built. Throws FixtureError for a fault that needs
// more than the machine (link, host), another moment than a time, or the project's own controller.
[[nodiscard]] ExperimentFixture with_faults_of_machine(const ExperimentFixture& fixture);

// From the records of both runs: whether anything differs (INVALID when nothing does), and whether
// the carriage met a hard end that it did not meet without.
[[nodiscard]] std::vector<Check> judge_beside_twin(const std::filesystem::path& folder,
                                                   const std::filesystem::path& twin);

}  // namespace towbench::harness
