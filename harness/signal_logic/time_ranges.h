// Which samples a bounded operator ranges over.
#pragma once

#include <vector>

#include "harness/signal_logic/formula.h"
#include "harness/signal_logic/sliding_minimum.h"
#include "harness/signal_logic/trace.h"

namespace towbench::harness {

// Times of a record are whole nanoseconds.
inline constexpr double kSameTime_s = 0.5e-9;

// For every sample, those within the bounds behind it.
[[nodiscard]] std::vector<SampleRange> ranges_of(const TimeBounds& bounds, const Trace& trace);
// Those of a window, whoever asks.
[[nodiscard]] SampleRange range_of(const TraceWindow& window, const Trace& trace);
// Where `formula`, a kAfter, demands its part: the stretches in which the samples count, in order,
// apart from each other.
[[nodiscard]] std::vector<SampleRange> obligations_of(const Formula& formula, const Trace& trace);

}  // namespace towbench::harness
