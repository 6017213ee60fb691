// One motion with the faults and setups that a search may choose for it.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "harness/falsify/fault_space.h"

namespace towbench::harness {

struct SearchSpace {
  std::size_t experiment = 0;  // which of those that are searched
  std::string motion{};        // its name; empty where there is one alone
  FaultSpace faults;

  [[nodiscard]] std::string name() const {
    return motion.empty() ? faults.name() : motion + ": " + faults.name();
  }
};

}  // namespace towbench::harness
