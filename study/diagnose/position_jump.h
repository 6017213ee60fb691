// A position that jumps: the counter was preset, or lost its place. No body moves like that, and
// one such sample would be the fastest motion of the log and hide all the rest.
#pragma once

#include "study/logs/finding.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

// Joins the pieces: what lies before a jump is moved into the frame of what follows. The sample at
// the jump counts as missing. Tells where.
void join_position_jumps(Run& run, logs::Findings& findings);

}  // namespace towbench::study::diagnose
