// A run of the same experiment on the same machine under the same seed, done before.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "harness/experiment/experiment_fixture.h"

namespace towbench::study::active {

// The run folder below `runs` that holds it, complete and passed; in lockstep a new one would have
// the same bits.
[[nodiscard]] std::optional<std::filesystem::path> earlier_run(
    const std::filesystem::path& runs, const harness::ExperimentFixture& fixture,
    std::uint64_t seed);

}  // namespace towbench::study::active
