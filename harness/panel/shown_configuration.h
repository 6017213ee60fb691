// What the panel takes a count for.
#pragma once

#include "bbmc/system/configuration.h"
#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

// BBMC's configuration; where a program follows the experiment's reference, which tells no beliefs,
// with scale and ends as the rig has them.
[[nodiscard]] bbmc::Configuration shown_configuration(const ExperimentFixture& fixture);

}  // namespace towbench::harness
