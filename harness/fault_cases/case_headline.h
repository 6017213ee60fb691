// What happened in a run with faults, in half a sentence: "stopped by the kill switch: zero duty
// after 0.9 ms, standstill after 31 mm".
#pragma once

#include <string>

#include "harness/fault_cases/fault_case.h"

namespace towbench::harness {

[[nodiscard]] std::string headline_of(const CaseVerdict& verdict);

}  // namespace towbench::harness
