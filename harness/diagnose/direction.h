// Which way a body moves, since when and how far, and where it stands.
#pragma once

#include "harness/diagnose/signals.h"

namespace towbench::harness::diagnose {

// Fills direction, since_reversal_*, standing from the speed. `resolution_m`: of the position.
void find_direction(Signals& signals, double resolution_m);

}  // namespace towbench::harness::diagnose
