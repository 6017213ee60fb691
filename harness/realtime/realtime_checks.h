// Judges how a run in real time was served. A late host proves nothing about the controller, so
// lateness makes a run INVALID; only what the controller's own work does can fail it.
#pragma once

#include <vector>

#include "harness/checks/check.h"
#include "harness/realtime/tick_summary.h"

namespace towbench::harness {

// OR-BBMC-3c: execution jitter below 5 % of the control period. Jitter is taken as the distance
// from the median to the 99th percentile.
inline constexpr double kMaxJitterShare = 0.05;

//   <side>_host_on_time    INVALID when more ticks were behind than the policy allows; names the
//   tick control_lateness       INVALID when the controller's wake-ups jitter more than the budget
//   control_jitter         FAIL when its execution does
//   All are INVALID for a side without a tick.
[[nodiscard]] Check host_on_time(const TickSummary& side);
[[nodiscard]] std::vector<Check> realtime_checks(const TickSummary& emulator,
                                                 const TickSummary& controller,
                                                 core::Nanoseconds control_period_ns);

}  // namespace towbench::harness
