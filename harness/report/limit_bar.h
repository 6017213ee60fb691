// The small bar beside a check: where the value lies between its limits.
#pragma once

#include <optional>
#include <string>

namespace towbench::harness::report {

struct LimitBar {
  double value = 0;  // all in the same unit
  std::optional<double> min;
  std::optional<double> max;
};

// The allowed band is solid, what lies outside is hatched, the value is a mark; a value off the
// scale is an arrow at its end. Empty without a limit or with a value that is not finite.
[[nodiscard]] std::string limit_bar(const LimitBar& bar);

}  // namespace towbench::harness::report
