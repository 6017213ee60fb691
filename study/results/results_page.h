// docs/measurements/results.md: every table of the thesis's chapters 7 and 8 with what the bench
// found and what is true of the emulated machine beside it. Holds no time of the host, so the same
// program writes the same page.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/procedures/sequence.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/recovery/recovery.h"
#include "study/results/own_gains.h"
#include "study/results/tracked_run.h"

namespace towbench::study {

struct TowResult {
  std::string id;
  std::string title;
  procedures::TowOutcome outcome;
  std::vector<Recovery> recoveries;
};

struct Results {
  std::string rig;
  emulator::RigParameters truth;  // of the machine
  procedures::SequenceResult identified;
  std::vector<TowResult> tows;
  std::vector<TrackedSpeed> slow;      // the 14 speeds of Table 7.6, thesis's trapezoids
  std::vector<TrackedSpeed> fast_air;  // the 6 speeds of Table 8.3
  std::vector<TrackedSpeed> fast_water;
  // 50 mm/s in air without the S-curve: ramps of 0.8 s, and of 0.3 s as BBMC's default has them.
  std::array<TrackedSpeed, 2> straight_ramps;
  std::vector<OwnGains> own_gains;  // the thesis's, BBMC 0.5's, the bench's
};

[[nodiscard]] std::string results_page(const Results& results);

}  // namespace towbench::study
