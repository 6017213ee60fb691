// What cyclictest reports of a series of times: extremes, mean, percentiles, and a histogram.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace towbench::harness::report {

struct Distribution {
  std::size_t samples = 0;
  double min = 0;
  double mean = 0;
  double p50 = 0;
  double p99 = 0;
  double p99_9 = 0;
  double max = 0;
};

// NaN are left out. Percentiles by nearest rank: each is a value that occurred.
[[nodiscard]] Distribution distribution_of(std::vector<double> values);

// An inline SVG with logarithmic bins and a logarithmic count axis, which is how a tail shows.
// `unit` labels the axis. Empty without a positive value.
[[nodiscard]] std::string histogram_svg(const std::vector<double>& values, const std::string& unit);

}  // namespace towbench::harness::report
