// towbench tow --drawn: the coverage of the tow experiments' intervals.
#pragma once

#include "study/results/tow_set.h"

namespace towbench::study {

// Runs the set, writes set.md into its folder and shows it unless `quiet`. Exit code: 1 an interval
// covers too seldom or too often, 4 a run is missing.
[[nodiscard]] int execute_tow_set(const TowSet& set, bool quiet);

}  // namespace towbench::study
