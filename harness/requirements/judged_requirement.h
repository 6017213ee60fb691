// A requirement held against a run.
#pragma once

#include <vector>

#include "harness/checks/check.h"
#include "harness/requirements/requirement.h"
#include "harness/signal_logic/robustness.h"

namespace towbench::harness {

struct JudgedRequirement {
  Check check{};  // `value` and `margin` are the margin; INVALID when there is none
  Robustness robustness{};
};

[[nodiscard]] JudgedRequirement judge_requirement(const Requirement& requirement,
                                                  const Trace& trace);

}  // namespace towbench::harness
