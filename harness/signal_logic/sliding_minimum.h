// The smallest value of each of a row of windows whose ends only move forward, linear in the
// samples: Lemire, Streaming maximum-minimum filter using no more than three comparisons per
// element, Nordic Journal of Computing 13 (2006), algorithm 1.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace towbench::harness {

struct SampleRange {
  std::size_t first = 0;
  std::size_t end = 0;  // one behind the last
};

// NaN where the window holds no number. Neither `first` nor `end` of a range is less than that of
// the range before it.
[[nodiscard]] std::vector<double> sliding_minimum(std::span<const double> values,
                                                  std::span<const SampleRange> windows);

}  // namespace towbench::harness
