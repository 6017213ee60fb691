#include "study/identify/window_means.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace towbench::study::identify {

Mean mean_of(const std::vector<double>& column, std::size_t from, std::size_t to) {
  constexpr std::size_t kBlocks = 10;
  to = std::min(to, column.size());
  Mean mean;
  if (to < from + 2 * kBlocks) {
    mean.standard_error = std::numeric_limits<double>::infinity();
    return mean;
  }
  const std::size_t block = (to - from) / kBlocks;
  double square = 0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    double sum = 0;
    for (std::size_t k = from + i * block; k < from + (i + 1) * block; ++k) {
      sum += column[k];
    }
    const double each = sum / static_cast<double>(block);
    mean.value += each / kBlocks;
    square += each * each / kBlocks;
  }
  mean.standard_error = std::sqrt(std::max(0.0, square - mean.value * mean.value) / (kBlocks - 1));
  return mean;
}

Mean smooth_mean_of(const std::vector<double>& column, std::size_t from, std::size_t to) {
  to = std::min(to, column.size());
  Mean mean;
  double weight = 0;
  for (std::size_t k = from; k < to; ++k) {
    const double share = (static_cast<double>(k - from) + 0.5) / static_cast<double>(to - from);
    const double each = 1 - std::cos(2 * std::numbers::pi * share);
    mean.value += each * column[k];
    weight += each;
  }
  mean.value /= std::max(weight, std::numeric_limits<double>::min());
  return mean;
}

std::size_t row_at(const Recording& data, double time_s) {
  return static_cast<std::size_t>(std::lower_bound(data.time_s.begin(), data.time_s.end(), time_s) -
                                  data.time_s.begin());
}

}  // namespace towbench::study::identify
