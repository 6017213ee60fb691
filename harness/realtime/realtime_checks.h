// Judges how a run in real time was served. A late host proves nothing about the controller, so
// lateness makes a run INVALID; only what the controller's own work does can fail it.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/checks/check.h"
#include "harness/realtime/realtime_budget.h"
#include "harness/realtime/tick_summary.h"

namespace towbench::harness {

// Fewer ticks have no 99.9th percentile.
inline constexpr std::uint64_t kFewestTicksOfJitter = 1000;

// p99.9 - p50 over the period.
[[nodiscard]] double jitter_ratio(const DurationFigures& figures, core::Nanoseconds period_ns);

//   <side>_host_on_time    INVALID when more ticks were behind than the policy allows; names the
//   tick control_lateness       INVALID when the controller's wake-ups jitter more than the budget
//   control_jitter         FAIL when its execution does, INVALID when the wake-ups of either side
//   do All are INVALID for a side without a tick, jitter for one with fewer than
//   kFewestTicksOfJitter.
[[nodiscard]] Check host_on_time(const TickSummary& side);
[[nodiscard]] std::vector<Check> realtime_checks(const TickSummary& emulator,
                                                 const TickSummary& controller,
                                                 core::Nanoseconds control_period_ns,
                                                 const RealtimeBudget& budget);

}  // namespace towbench::harness
