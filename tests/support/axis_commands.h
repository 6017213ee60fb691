// The six command histories on which convergence and speed are judged, in volts, one value a tick.
#pragma once

#include <string>
#include <vector>

namespace towbench::tests {

struct CommandHistory {
  std::string name;
  std::vector<double> volts;  // one a 100 us tick
};

// Pulses, saturating pulses, sine, slow stick-slip, random steps, square waves.
[[nodiscard]] std::vector<CommandHistory> command_histories(double duration_s);

}  // namespace towbench::tests
