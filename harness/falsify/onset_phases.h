// The phases of a motion as parts of the time in which a fault may begin.
#pragma once

#include <vector>

#include "harness/falsify/box_sampler.h"
#include "harness/falsify/fault_space.h"
#include "harness/fault_cases/case_record.h"

namespace towbench::harness {

// Shares of the time to the end of the fault-free run, of the axis whose motion the fault goes by.
[[nodiscard]] std::vector<Stretch> onset_phases(const FaultChoice& choice,
                                                const CaseRecord& reference);

}  // namespace towbench::harness
