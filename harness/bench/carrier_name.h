// What a run went over, as its record names it.
#pragma once

#include <string>

#include "harness/bench/experiment_run.h"

namespace towbench::harness {

// "in-process", "virtual board", "local", "serial:...", with the real lines behind.
[[nodiscard]] std::string name_of_carrier(const RunOptions& options);

}  // namespace towbench::harness
