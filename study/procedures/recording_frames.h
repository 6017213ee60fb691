// Where a controller is told its position its counts jump, faster than any axis moves.
#pragma once

#include "study/identify/recording.h"

namespace towbench::study::procedures {

// Drops the rows before the last such jump: they are in another frame and nothing was driven yet.
void drop_other_frames(identify::Recording& recording);

}  // namespace towbench::study::procedures
