#include "harness/checks/check.h"

#include <algorithm>
#include <utility>

namespace towbench::harness {

Check invalid_check(std::string name, std::string meaning, std::string reason) {
  Check check;
  check.name = std::move(name);
  check.meaning = std::move(meaning);
  check.verdict = Verdict::kInvalid;
  check.reason = std::move(reason);
  return check;
}

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
