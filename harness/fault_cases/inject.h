// A plan of faults as what makes them happen (harness/lockstep/injection.h). The controller's code
// is never touched.
#pragma once

#include "emulator/rig_parameters.h"
#include "harness/fault_cases/case_record.h"
#include "harness/fault_plan/fault.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

// Adds one fault that begins at `at_ns`. `reference` is the run without it: where a contact is
// to bounce at its next edge, the reference run knows when that is. `end_ns` is where the run ends
// at the latest.
void inject(const Fault& fault, core::Nanoseconds at_ns, const CaseRecord& reference,
            core::Nanoseconds end_ns, Injection& injection);
// Puts events in order and drops those of encoders that the rig has not; after the last inject().
void finish(Injection& injection, const emulator::RigParameters& rig);

}  // namespace towbench::harness
