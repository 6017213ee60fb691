// Whether what a tow experiment estimated agrees with the emulated water. Looks at the rig after
// everything has been estimated, as recovery.h does for the machine.
#pragma once

#include <vector>

#include "study/procedures/tow/tow_procedure.h"
#include "study/recovery/recovery.h"

namespace towbench::study {

// Of every estimate that has a truth, in their order; a tolerance of 0: docs/requirements.md (TOW)
// makes no demand on it. `towed`: the rig with the load whose drag was sought. Drag that a
// position-blind model predicted is judged against the closed form of its bias
// (blind_model_bias.h).
[[nodiscard]] std::vector<Recovery> judge_tow(const emulator::RigParameters& towed,
                                              const procedures::TowOutcome& outcome);

}  // namespace towbench::study
