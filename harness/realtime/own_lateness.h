// How late this host wakes the bench's own loop at 10 kHz, without any work in it.
#pragma once

#include <string>

#include "core/time.h"
#include "harness/realtime/host_findings.h"
#include "harness/realtime/tick_summary.h"

namespace towbench::harness {

// Takes real-time rights for a thread of its own, so that the caller keeps what it had.
[[nodiscard]] TickSummary measure_own_lateness(core::Nanoseconds duration_ns);

// Good below a twentieth of the emulator's tick at p99 (OR-BBMC-3c at 10 kHz); limited up to a
// twentieth of the controller's at 1 kHz; else not fit for real time.
[[nodiscard]] Finding lateness_finding(const TickSummary& summary);

}  // namespace towbench::harness
