// Runs that something moves which no log has: a hand, a cable that catches. They hide in all runs
// together what the others show.
#pragma once

#include <optional>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// The diagnosis of the other runs, where that of all of them leaves something unexplained: without
// the run that is predicted worst, or the two worst. At least half of the runs stay. None where
// the others are not explained either, or those left out are predicted about as well as they are.
[[nodiscard]] std::optional<Diagnosis> without_unlike_runs(
    const Request& request, const Diagnosis& all, Diagnosis (*diagnose_all)(const Request&));

}  // namespace towbench::study::diagnose
