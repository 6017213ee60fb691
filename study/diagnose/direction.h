// Which way a body moves, since when and how far, and where it stands.
#pragma once

#include "study/diagnose/signals.h"

namespace towbench::harness::diagnose {

inline constexpr double kStandingShare = 2e-3;  // of the largest speed

// Fills direction, since_reversal_*, standing from the speed. `resolution_m`: of the position.
void find_direction(Signals& signals, double resolution_m, double standing_share = kStandingShare);

}  // namespace towbench::harness::diagnose
