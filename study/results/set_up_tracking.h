// Table 7.6 with BBMC as its files are and told its place, beside BBMC set up from an
// identification of the same machine and homed on its switches.
#pragma once

#include <string>
#include <vector>

#include "study/identify/estimate.h"
#include "study/procedures/machine.h"
#include "study/results/tracked_run.h"

namespace towbench::study {

struct SetUpTracking {
  std::string controller;            // name of its fixture
  std::vector<TrackedSpeed> told;    // as the file is
  std::vector<TrackedSpeed> set_up;  // set up and homed
  std::string trouble;               // why it could not be set up; empty: it was
};

// With bbmc-tuned on trapezoids and bbmc-best on S-curves, each averaged over a period of the
// transmission as the controller believes it. Throws FixtureError.
[[nodiscard]] std::vector<SetUpTracking> track_set_up(const harness::RigFixture& rig,
                                                      const procedures::Machine& machine,
                                                      const identify::Estimates& estimates);

// Markdown, one section of the machine `name`.
[[nodiscard]] std::string set_up_section(const std::string& name,
                                         const std::vector<SetUpTracking>& all);

}  // namespace towbench::study
