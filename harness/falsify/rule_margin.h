// Checks as one number and one sentence.
#pragma once

#include <span>

#include "harness/checks/check.h"
#include "harness/falsify/objective.h"

namespace towbench::harness {

// Sets margin, broken and reason; a run that is INVALID has no margin.
void add_margin_of(std::span<const Check> checks, Outcome& outcome);

}  // namespace towbench::harness
