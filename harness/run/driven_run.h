// A run that a person drove, as an experiment that replays it.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "harness/lockstep/operator.h"

namespace towbench::harness {

// `onsets_ns`: when the experiment's own faults began in that run, in their order.
[[nodiscard]] ExperimentFixture as_driven(const ExperimentFixture& fixture,
                                          const std::vector<core::Nanoseconds>& onsets_ns,
                                          const InteractiveOperator& run_operator);

}  // namespace towbench::harness
