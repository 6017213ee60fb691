// What a run by the wall clock may jitter by: fixtures/budgets/real-time.toml, one file for all
// runs.
#pragma once

#include <string>

#include "harness/fixtures/fixture_file.h"

namespace towbench::harness {

// OR-BBMC-3c. Jitter is the distance from the median to the 99.9th percentile (p99.9), over the
// control period.
struct RealtimeBudget {
  double jitter_p999_max_ratio = 0;  // above 0, at most 1
  std::string source;                // where the figure comes from
};

// Throws FixtureError; nothing in the file has a default.
[[nodiscard]] RealtimeBudget read_realtime_budget(const FixtureFile& file);
// The project's own.
[[nodiscard]] RealtimeBudget load_realtime_budget(SourceFiles& sources);

}  // namespace towbench::harness
