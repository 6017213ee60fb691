#include "harness/board_bench/board_budgets.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

void judge(Check& check, double value, double max) {
  check.value = value;
  check.max = max;
  check.margin = max > 0 ? (max - value) / max : max - value;
  check.verdict = value <= max ? Verdict::kPass : Verdict::kFail;
  check.reason = value <= max ? "" : fmt::format("{} is more than {}", value, max);
}

Check instructions_check(const BoardBudget& budget, const board::Board& board) {
  Check check;
  check.name = fmt::format("interrupt_{}_worst_instructions", budget.interrupt);
  check.meaning = "instructions of the interrupt's longest service, without those nested in it";
  const auto& cost = board.profile().interrupt(budget.interrupt);
  if (cost.count == 0) {
    check.reason = fmt::format("interrupt {} was never served", budget.interrupt);
  } else {
    judge(check, static_cast<double>(cost.worst), budget.max);
  }
  return check;
}

Check stack_check(const BoardBudget& budget, const DebugProbe& probe) {
  Check check;
  check.name = "stack_bytes";
  check.meaning = "deepest use of the stack";
  check.unit = "byte";
  if (const auto used = probe.stack_used()) {
    judge(check, *used, budget.max);
  } else {
    check.reason =
        "the stack lies among other data of the image and has no symbols: its depth is "
        "not known";
  }
  return check;
}

}  // namespace

std::vector<Check> board_budget_checks(const std::vector<BoardBudget>& budgets,
                                       const board::Board& board, const DebugProbe& probe) {
  std::vector<Check> checks;
  for (const BoardBudget& budget : budgets) {
    const bool stack = budget.metric == BoardBudget::Metric::kStackBytes;
    checks.push_back(stack ? stack_check(budget, probe) : instructions_check(budget, board));
    checks.back().source = budget.source;
  }
  return checks;
}

}  // namespace towbench::harness
