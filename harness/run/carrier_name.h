// What a run went over, as its record names it.
#pragma once

#include <string>

#include "harness/run/experiment_run.h"

namespace towbench::harness {

// "in-process", "virtual board", "local", "serial:...", with the real lines behind.
[[nodiscard]] std::string name_of_carrier(const RunOptions& options);

// Whether the carrier brings every edge of the encoders; else a digest.
[[nodiscard]] bool takes_edges(const RunOptions& options);
// "edges", "digest", or "lines": encoders on lines of their own. Results compare bit for bit within
// one of these only.
[[nodiscard]] const char* fidelity_of(const RunOptions& options);

}  // namespace towbench::harness
