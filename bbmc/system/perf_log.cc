#include "bbmc/system/perf_log.h"

#include <bit>

namespace towbench::bbmc {
namespace {

void add(PerfLog::Statistics& statistics, core::Nanoseconds value_ns) noexcept {
  value_ns = value_ns < 0 ? 0 : value_ns;
  if (statistics.samples == 0 || value_ns < statistics.min_ns) {
    statistics.min_ns = value_ns;
  }
  if (value_ns > statistics.max_ns) {
    statistics.max_ns = value_ns;
  }
  statistics.sum_ns += value_ns;
  ++statistics.samples;
  const auto whole_us = static_cast<std::uint64_t>(value_ns / core::kNanosecondsPerMicrosecond);
  const auto bucket = static_cast<std::size_t>(std::bit_width(whole_us));
  ++statistics.histogram[bucket < PerfLog::kBuckets ? bucket : PerfLog::kBuckets - 1];
}

}  // namespace

void PerfLog::reset() noexcept {
  lateness_ = {};
  execution_ = {};
}

void PerfLog::record(core::Nanoseconds lateness_ns, core::Nanoseconds execution_ns) noexcept {
  if (enabled_) {
    add(lateness_, lateness_ns);
    add(execution_, execution_ns);
  }
}

}  // namespace towbench::bbmc
