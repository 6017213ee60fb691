// Which motion would tell two causes apart: T-optimal choice (Atkinson & Fedorov 1975).
//
// Each trajectory of the bench's menu, inside the stroke, speed and acceleration that the data
// used, is driven with one model, and the other is fitted to what came of it. The best one leaves
// most.
#pragma once

#include <optional>
#include <string>

#include "study/diagnose/trial_motion.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

struct NextExperiment {
  TrialMotion motion;         // of the menu
  std::string alternative;    // from which it separates
  double separation_N = 0;    // rms left of the cause
  double in_this_data_N = 0;  // the same in the data at hand
};

// None when no motion of the menu separates them: then only another sensor or mass does.
// `cause`: the model found; `other`: the best with an alternative in its place.
[[nodiscard]] std::optional<NextExperiment> separate(const Search& search, const Model& cause,
                                                     const State& other,
                                                     const std::string& alternative);

}  // namespace towbench::study::diagnose
