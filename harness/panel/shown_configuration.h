// What the panel takes a count for.
#pragma once

#include "bbmc/system/configuration.h"
#include "harness/checks/recorded_axes.h"
#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

struct ShownMachine {
  // Of BBMC's two axes.
  explicit ShownMachine(const bbmc::Configuration& configuration);

  RecordedAxes shown;
  core::PerAxis<bbmc::AxisConfiguration> axes;
  double control_rate_Hz;
};

// BBMC's configuration; where a program follows the experiment's reference, which tells no beliefs,
// with scale and ends as the rig has them.
[[nodiscard]] ShownMachine shown_configuration(const ExperimentFixture& fixture);

}  // namespace towbench::harness
