// An experiment as the text of a file that reads back as the same experiment.
#pragma once

#include <string>

#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

// `rig` and `controller` are the paths that the text names.
[[nodiscard]] std::string to_toml(const ExperimentFixture& fixture, const std::string& rig,
                                  const std::string& controller, const std::string& wiring = {});

// The text of the fixture's first source with the paths that it names already.
[[nodiscard]] std::string to_toml(const ExperimentFixture& fixture);

}  // namespace towbench::harness
