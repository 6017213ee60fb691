// A separating experiment as an ordinary experiment file, on the rig that the first log came from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "study/diagnose/trial_motion.h"

namespace towbench::study::active {

// Where and how the first log was recorded, from what its run folder keeps. Nothing of what the
// machine truly is leaves this struct but into the files of the next run.
struct Site {
  harness::ExperimentFixture recorded;  // the experiment of the run folder
  std::filesystem::path rig_file;
  std::vector<harness::ConsoleStep> prologue{};  // tells the controller where it stands
  std::string axis;
  double start_m = 0;  // of the axis, by the prologue
};

// `rig`: the machine as the user names it, which must be the one that the folder was recorded on;
// empty: the folder's own copy. Throws FixtureError.
[[nodiscard]] Site find_site(const std::filesystem::path& run_folder,
                             const std::filesystem::path& rig, const std::string& axis);

// A known force on the carriage for a part of the run, + towards max: a weight on a cord.
struct Push {
  double force_N = 0;
  double from_s = 0;
  double to_s = 0;
};

struct Trial {
  std::string name;
  std::string asks;  // which causes it is to tell apart
  diagnose::TrialMotion motion;
  std::optional<Push> push{};  // within the motion; filled with times by write_trial
};

// Writes folder/<name>.toml and reads it back as what will be run. Throws FixtureError,
// filesystem_error.
[[nodiscard]] harness::ExperimentFixture write_trial(const Site& site, Trial& trial,
                                                     const std::filesystem::path& folder);

}  // namespace towbench::study::active
