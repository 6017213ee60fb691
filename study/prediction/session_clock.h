// When runs began in their session, by the clock of their logs.
#pragma once

#include <vector>

#include "study/prediction/run.h"

namespace towbench::study::diagnose {

// Seconds since the earliest began, of runs that one clock has timed: none begins before another
// ends, and no pause is longer than an hour. Otherwise empty.
[[nodiscard]] std::vector<double> starts_on_one_clock(const std::vector<const Run*>& runs);

}  // namespace towbench::study::diagnose
