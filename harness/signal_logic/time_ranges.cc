#include "harness/signal_logic/time_ranges.h"

#include <algorithm>

namespace towbench::harness {
namespace {

std::size_t first_from(const std::vector<double>& time_s, double from_s) {
  return static_cast<std::size_t>(
      std::lower_bound(time_s.begin(), time_s.end(), from_s - kSameTime_s) - time_s.begin());
}

const std::vector<double>& times_of(const Trace& trace, const std::string& event) {
  static const std::vector<double> kNever;
  const auto found = trace.events.find(event);
  return found == trace.events.end() ? kNever : found->second;
}

}  // namespace

std::vector<SampleRange> ranges_of(const TimeBounds& bounds, const Trace& trace) {
  const auto& time_s = trace.time_s;
  std::vector<SampleRange> ranges(time_s.size());
  SampleRange range;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    while (range.first < time_s.size() &&
           time_s[range.first] < time_s[i] + bounds.from_s - kSameTime_s) {
      ++range.first;
    }
    while (range.end < time_s.size() &&
           time_s[range.end] <= time_s[i] + bounds.to_s + kSameTime_s) {
      ++range.end;
    }
    ranges[i] = {range.first, std::max(range.first, range.end)};
  }
  return ranges;
}

SampleRange range_of(const TraceWindow& window, const Trace& trace) {
  const auto& time_s = trace.time_s;
  const auto first = first_from(time_s, window.from_s);
  const auto end = std::upper_bound(time_s.begin(), time_s.end(), window.to_s + kSameTime_s);
  return {first, std::max(first, static_cast<std::size_t>(end - time_s.begin()))};
}

std::vector<SampleRange> obligations_of(const Formula& formula, const Trace& trace) {
  const auto& time_s = trace.time_s;
  const auto& ends_s = times_of(trace, formula.until);
  std::vector<SampleRange> ranges;
  for (const double event_s : times_of(trace, formula.event)) {
    const double due_s = event_s + formula.bounds.to_s;
    const auto until = std::upper_bound(ends_s.begin(), ends_s.end(), event_s);
    const bool ends = until != ends_s.end();
    if (time_s.empty() || time_s.back() < due_s - kSameTime_s || (ends && *until <= due_s)) {
      continue;  // over before it was due
    }
    // The value that holds when it is due is that of the last sample.
    auto first = first_from(time_s, due_s);
    first -= first > 0 && time_s[first] > due_s + kSameTime_s ? 1U : 0U;
    const auto end = ends ? first_from(time_s, *until) : time_s.size();
    if (!ranges.empty() && first <= ranges.back().end) {
      ranges.back().end = std::max(ranges.back().end, end);
    } else if (end > first) {
      ranges.push_back({first, end});
    }
  }
  return ranges;
}

}  // namespace towbench::harness
