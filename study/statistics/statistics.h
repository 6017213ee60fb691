// Order statistics and the normal distribution's 95 %, for all that estimates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace towbench::study::statistics {

// A normal deviate is within +- so many standard deviations in 95 % of the cases: the 97.5 %
// quantile of the standard normal distribution.
inline constexpr double kNormal95 = 1.959964;

namespace detail {

[[nodiscard]] inline double nth_of(std::vector<double> values, std::size_t n) {
  if (values.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace detail

// The sample that the share `share`, 0 to 1, of the others does not exceed; NaN of nothing.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  const auto last = static_cast<double>(values.empty() ? 0 : values.size() - 1);
  return detail::nth_of(std::move(values), static_cast<std::size_t>(share * last));
}

// The middle sample, of an even number the upper one; NaN of nothing.
[[nodiscard]] inline double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  return detail::nth_of(std::move(values), middle);
}

}  // namespace towbench::study::statistics
