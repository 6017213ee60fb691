// Whether a force of no library shows as one in a motion, from the generator's own truth; no
// diagnosis is asked.
//
// In laps of one speed a force of place and speed is a force of the place. The lacking force is
// averaged over blocks while the axis moves; laws of textbooks are fitted to it, each by itself
// beside the parameters of the file.
#pragma once

#include <vector>

#include "tests/study/diagnose/foreign/recording.h"

namespace towbench::tests::foreign {

// Of the rms that the file's parameters leave, the share that the best law leaves too.
[[nodiscard]] double beyond_laws(const Machine& machine, const std::vector<Recording>& runs);

}  // namespace towbench::tests::foreign
