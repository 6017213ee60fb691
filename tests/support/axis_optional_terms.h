// Every optional term of the axis at a size that shows, for tests and benchmarks.
#pragma once

#include <string>
#include <vector>

#include "emulator/plant/axis_parameters.h"

namespace towbench::tests {

struct OptionalTerm {
  std::string name;
  void (*add_to)(emulator::AxisParameters& axis);
};

// Each alone. Slack is among them, though it excludes pre-tension.
[[nodiscard]] std::vector<OptionalTerm> optional_terms();

// All but slack, at once.
[[nodiscard]] emulator::AxisParameters with_every_term(emulator::AxisParameters axis);

}  // namespace towbench::tests
