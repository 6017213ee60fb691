// A run by the wall clock once more, without a clock: each side hears again what its record says it
// heard in each of its ticks. The controller computes the same duty and the plant moves the same
// way, to the last bit, or the record is not the whole truth about the run.
#pragma once

#include <filesystem>

#include "harness/experiment/experiment_fixture.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

// `recorded`: the run's folder, with both sides' inputs. Writes log.csv, truth.csv and events.jsonl
// below `out`. Throws std::filesystem::filesystem_error for an input that cannot be read.
[[nodiscard]] RunResult replay_by_inputs(const ExperimentFixture& fixture, std::uint64_t seed,
                                         const std::filesystem::path& recorded,
                                         const std::filesystem::path& out);

}  // namespace towbench::harness
