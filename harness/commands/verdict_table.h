// The checks of runs as a table for a terminal.
#pragma once

#include <string>

#include "harness/run/experiment_run.h"

namespace towbench::harness {

// One block a run: its verdict, then one line a check. `all`: passed checks too.
[[nodiscard]] std::string verdict_table(const std::string& experiment, const RunResult& run,
                                        bool all);

// A number with the prefix that suits it: "312 um", "0.4 m/s", "302".
[[nodiscard]] std::string with_unit(double value, const std::string& unit);

}  // namespace towbench::harness
