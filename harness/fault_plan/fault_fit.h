// Whether a machine has the part that a fault strikes.
#pragma once

#include "emulator/rig_parameters.h"
#include "harness/fault_plan/fault.h"

namespace towbench::harness {

// What the rig would have to have, in words for a refusal; null: it has it.
[[nodiscard]] const char* lacking(const Fault& fault, const emulator::RigParameters& rig) noexcept;

}  // namespace towbench::harness
