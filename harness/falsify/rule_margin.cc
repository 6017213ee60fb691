#include "harness/falsify/rule_margin.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness {
namespace {

double margin_of(const Check& check) {
  if (check.verdict != Verdict::kPass) {
    return check.margin ? std::min(*check.margin, -1e-9) : -1;
  }
  if (check.margin) {
    return std::clamp(*check.margin, 0.0, 1.0);
  }
  if (check.value && check.max && *check.max != 0 && !check.min) {
    return std::clamp((*check.max - *check.value) / std::fabs(*check.max), 0.0, 1.0);
  }
  return 1;
}

}  // namespace

void add_margin_of(std::span<const Check> checks, Outcome& outcome) {
  for (const auto& check : checks) {
    if (check.verdict == Verdict::kInvalid) {
      outcome.margin.reset();
      outcome.rules.clear();
      outcome.broken = false;
      outcome.reason = check.name + ": " + check.reason;
      return;
    }
    const double margin = margin_of(check);
    const auto rule = outcome.rules.try_emplace(check.name, margin).first;
    rule->second = std::min(rule->second, margin);
    if (!outcome.margin || margin < *outcome.margin) {
      outcome.margin = margin;
      outcome.broken = check.verdict == Verdict::kFail;
      outcome.reason = check.name + (check.reason.empty() ? "" : ": " + check.reason);
    }
  }
}

}  // namespace towbench::harness
