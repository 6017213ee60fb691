// How a run went, before anything is judged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"

namespace towbench::harness {

struct RunOutcome {
  bool complete = false;  // ran to its end; else `reason` says what ended it
  std::string reason;
  std::string script_failure;  // empty when every console step was carried out
  core::Nanoseconds end_ns = 0;
  std::vector<core::Nanoseconds> typed_ns;      // when anything was, to an image
  std::vector<core::Nanoseconds> restarted_ns;  // when the image began again
  core::Nanoseconds exchange_ns = 0;
  core::Nanoseconds control_period_ns = 0;
  double wall_time_s = 0;
  std::uint64_t log_rows = 0;
  std::uint64_t rows_lost = 0;
  bool writes_succeeded = true;
};

}  // namespace towbench::harness
