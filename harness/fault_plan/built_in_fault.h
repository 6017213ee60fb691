// A fault that the machine has from the start: a sensor fitted elsewhere, late, or not at all.
#pragma once

#include "emulator/rig_parameters.h"
#include "harness/fault_plan/fault.h"

namespace towbench::harness {

// Changes nothing for a fault of another kind.
void build_in(const Fault& fault, emulator::RigParameters& rig);

}  // namespace towbench::harness
