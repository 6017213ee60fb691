// Which motion would tell two causes apart: T-optimal choice (Atkinson & Fedorov 1975).
//
// Each trajectory of the bench's menu, inside the stroke, speed and acceleration that the data
// used, is run through both effects' columns. The best one leaves most of the cause's contribution
// when the nominal columns and the alternative have taken all they can.
#pragma once

#include <optional>
#include <string>

#include "study/diagnose/selection.h"
#include "study/diagnose/trial_motion.h"

namespace towbench::harness::diagnose {

struct NextExperiment {
  TrialMotion motion;         // of the menu
  std::string alternative;    // from which it separates
  double separation_N = 0;    // rms left of the cause
  double in_this_data_N = 0;  // the same in the data at hand
};

// None when no motion of the menu separates them: then only another sensor or mass does.
[[nodiscard]] std::optional<NextExperiment> separate(const Dataset& data, const Context& context,
                                                     const Cause& cause,
                                                     const Alternative& alternative);

}  // namespace towbench::harness::diagnose
