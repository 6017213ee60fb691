#include "harness/requirements/judged_requirement.h"

#include <fmt/format.h>

namespace towbench::harness {

JudgedRequirement judge_requirement(const Requirement& requirement, const Trace& trace) {
  JudgedRequirement judged{.robustness = robustness_of(requirement.parsed.formula, trace)};
  auto& check = judged.check;
  const auto& found = judged.robustness;
  check.name = requirement.id;
  check.meaning = requirement.text;
  check.unit = requirement.parsed.unit == "1" ? "" : requirement.parsed.unit;
  check.source = requirement.source;
  check.min = 0;
  if (!found.margin) {
    check.reason = "no sample or occasion in the run to judge this by";
    return judged;
  }
  check.value = check.margin = found.margin;
  check.verdict = found.holds ? Verdict::kPass : Verdict::kFail;
  if (!found.holds) {
    const auto where = found.worst_s ? fmt::format(" at {:.4f} s", *found.worst_s) : "";
    check.reason = fmt::format("the margin is {:.6g} {}{}", *found.margin, check.unit, where);
  }
  return judged;
}

}  // namespace towbench::harness
