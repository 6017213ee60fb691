#include "harness/realtime/duration_histogram.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness {

core::Nanoseconds DurationHistogram::percentile_ns(double share) const noexcept {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t us = 0; us < kBins; ++us) {
    below += bins_[us];
    if (below >= wanted && below > 0) {
      return std::min(static_cast<core::Nanoseconds>(us + 1) * core::kNanosecondsPerMicrosecond,
                      max_ns_);
    }
  }
  return max_ns_;
}

}  // namespace towbench::harness
