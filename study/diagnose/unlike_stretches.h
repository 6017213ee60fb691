// Stretches of a run in which something moves the axis that no log has: a hand, a cable that
// catches.
#pragma once

#include <optional>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// The diagnosis without the stretches of half a second or longer that are predicted far worse than
// the rest, where that of all leaves something unexplained or some are ten times worse. None where
// the rest is not explained either, or lacks about as much.
[[nodiscard]] std::optional<Diagnosis> without_unlike_stretches(
    const Request& request, const Diagnosis& all, Diagnosis (*diagnose_all)(const Request&));

}  // namespace towbench::study::diagnose
