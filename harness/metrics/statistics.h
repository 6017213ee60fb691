// Peak, RMS and mean of a stream of samples.
#pragma once

#include <cmath>
#include <cstddef>

#include "harness/metrics/metric.h"

namespace towbench::harness {

class Statistics {
 public:
  void add(double sample) noexcept {
    peak_ = std::max(peak_, std::fabs(sample));
    sum_ += sample;
    sum_of_squares_ += sample * sample;
    finite_ = finite_ && std::isfinite(sample);
    ++count_;
  }

  [[nodiscard]] MetricValue peak() const noexcept { return told(peak_); }
  [[nodiscard]] MetricValue mean() const noexcept { return told(sum_ / divisor()); }
  [[nodiscard]] MetricValue rms() const noexcept {
    return told(std::sqrt(sum_of_squares_ / divisor()));
  }

 private:
  [[nodiscard]] double divisor() const noexcept { return static_cast<double>(count_); }
  // std::max passes NaN by, so a single sample that is no number spoils the whole openly.
  [[nodiscard]] MetricValue told(double value) const noexcept {
    return count_ == 0 || !finite_ ? MetricValue{} : MetricValue{value, count_};
  }

  double peak_ = 0;
  double sum_ = 0;
  double sum_of_squares_ = 0;
  std::size_t count_ = 0;
  bool finite_ = true;
};

}  // namespace towbench::harness
