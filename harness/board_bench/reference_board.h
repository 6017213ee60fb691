// The same image on the same machine without the machine's faults.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/reference_run.h"

namespace towbench::harness {

// Its record has rows and events of an image that tells them (debug_probe.h). Throws FixtureError
// when the image cannot be loaded.
[[nodiscard]] std::shared_ptr<const ReferenceRun> run_reference_board(
    const ExperimentFixture& sound, const std::filesystem::path& image, std::uint64_t seed);

}  // namespace towbench::harness
