#include "harness/signal_logic/sliding_minimum.h"

#include <cmath>
#include <limits>

namespace towbench::harness {

std::vector<double> sliding_minimum(std::span<const double> values,
                                    std::span<const SampleRange> windows) {
  std::vector<double> smallest;
  smallest.reserve(windows.size());
  // Candidates in order of time, each smaller than those behind it are not: rising values.
  std::vector<std::size_t> rising;
  std::size_t head = 0;
  std::size_t seen = 0;
  for (const auto& window : windows) {
    for (; seen < window.end; ++seen) {
      if (std::isnan(values[seen])) {
        continue;
      }
      while (rising.size() > head && values[rising.back()] >= values[seen]) {
        rising.pop_back();
      }
      rising.push_back(seen);
    }
    while (head < rising.size() && rising[head] < window.first) {
      ++head;
    }
    smallest.push_back(head < rising.size() ? values[rising[head]]
                                            : std::numeric_limits<double>::quiet_NaN());
  }
  return smallest;
}

}  // namespace towbench::harness
