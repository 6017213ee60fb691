// One side of the box that a search looks into.
#pragma once

#include <string>
#include <vector>

#include "harness/falsify/box_sampler.h"

namespace towbench::harness {

struct SearchVariable {
  std::string name;  // "at_s", "duration_s", a parameter's key; of a second fault with "second "
  double from = 0;
  double to = 1;
  bool logarithmic = false;
  bool whole = false;     // whole numbers alone
  bool may_last = false;  // in the last fifth: to the end of the run
  bool is_moment = false;
  std::vector<Stretch> phases{};  // of a moment: the motion's
};

// `share`: 0 .. 1 of the range.
[[nodiscard]] double value_at(const SearchVariable& variable, double share) noexcept;

}  // namespace towbench::harness
