#include "harness/checks/check.h"

#include <algorithm>

namespace towbench::harness {

Verdict worst_of(std::span<const Check> checks) noexcept {
  if (checks.empty()) {
    return Verdict::kInvalid;
  }
  Verdict worst = Verdict::kPass;
  for (const auto& check : checks) {
    worst = std::max(worst, check.verdict);
  }
  return worst;
}

}  // namespace towbench::harness
