// Judges what an image has spent: instructions of an interrupt's worst service, depth of the stack.
#pragma once

#include <vector>

#include "board/board.h"
#include "harness/board_bench/debug_probe.h"
#include "harness/checks/check.h"
#include "harness/experiment/board_plan.h"

namespace towbench::harness {

// One for each budget: INVALID where there is no such figure.
[[nodiscard]] std::vector<Check> board_budget_checks(const std::vector<BoardBudget>& budgets,
                                                     const board::Board& board,
                                                     const DebugProbe& probe);

}  // namespace towbench::harness
