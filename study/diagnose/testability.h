// What this data could not have shown, whatever the truth: said, so that silence is no acquittal.
#pragma once

#include <string>
#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

// Standard errors of an effect's size at which it is seen: alpha 1e-3 over some hundred groups.
inline constexpr double kDetection = 5;

struct NotTestable {
  std::string effect;
  std::string why;
  std::string needs;
};

// Not testable: the data gives no columns at all; what is left of the group off the model's columns
// is below 5 %; or an effect must exceed 5 % of the force's rms to be detected.
[[nodiscard]] std::vector<NotTestable> find_not_testable(const Search& search);

}  // namespace towbench::study::diagnose
