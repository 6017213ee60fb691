// How late this host wakes the bench's own loop at 10 kHz, without any work in it.
#pragma once

#include <string>

#include "core/time.h"
#include "harness/realtime/host_findings.h"
#include "harness/realtime/realtime_budget.h"
#include "harness/realtime/tick_summary.h"

namespace towbench::harness {

// Takes real-time rights for a thread of its own, so that the caller keeps what it had.
[[nodiscard]] TickSummary measure_own_lateness(core::Nanoseconds duration_ns);

// Good when its jitter keeps the budget at 10 kHz, limited when it does at 1 kHz, else not fit for
// real time. Too few ticks for p99.9 are no measurement.
[[nodiscard]] Finding lateness_finding(const TickSummary& summary, const RealtimeBudget& budget);

}  // namespace towbench::harness
