#include "study/identify/tow/block_mean.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

namespace towbench::study::identify {

UncertainMean mean_of_repeats(std::span<const double> repeats) {
  const auto n = static_cast<double>(repeats.size());
  UncertainMean mean{.standard_error = std::numeric_limits<double>::infinity()};
  if (repeats.empty()) {
    return mean;
  }
  for (const double each : repeats) {
    mean.value += each / n;
  }
  if (repeats.size() < 2) {
    return mean;
  }
  double squares = 0;
  for (const double each : repeats) {
    squares += (each - mean.value) * (each - mean.value);
  }
  mean.degrees_of_freedom = n - 1;
  mean.standard_error = std::sqrt(squares / mean.degrees_of_freedom / n);
  return mean;
}

namespace {

std::vector<double> means_of_blocks(std::span<const double> samples, std::size_t block_rows) {
  constexpr std::size_t kFewest = 4;
  constexpr std::size_t kMost = 40;
  const auto blocks =
      std::clamp(samples.size() / std::max<std::size_t>(block_rows, 1), kFewest, kMost);
  std::vector<double> means;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t first = block * samples.size() / blocks;
    const std::size_t last = (block + 1) * samples.size() / blocks;
    double sum = 0;
    for (const double each : samples.subspan(first, last - first)) {
      sum += each;
    }
    means.push_back(sum / static_cast<double>(last - first));
  }
  return means;
}

// Scatter about the line through evenly spaced values.
UncertainMean mean_about_line(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  auto mean = mean_of_repeats(values);
  double cross = 0;
  double square = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double at = static_cast<double>(i) - 0.5 * (n - 1);
    cross += at * (values[i] - mean.value);
    square += at * at;
  }
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double at = static_cast<double>(i) - 0.5 * (n - 1);
    const double rest = values[i] - mean.value - cross / square * at;
    squares += rest * rest;
  }
  mean.degrees_of_freedom = n - 2;
  mean.standard_error = std::sqrt(squares / mean.degrees_of_freedom / n);
  return mean;
}

std::vector<double> running_mean(std::span<const double> samples, std::size_t rows) {
  std::vector<double> means;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += samples[i];
    if (i >= rows) {
      sum -= samples[i - rows];
    }
    if (i + 1 >= rows) {
      means.push_back(sum / static_cast<double>(rows));
    }
  }
  return means;
}

constexpr std::size_t kFewestSamples = 8;

}  // namespace

UncertainMean block_mean(std::span<const double> samples, std::size_t block_rows) {
  if (samples.size() < kFewestSamples) {
    return {.standard_error = std::numeric_limits<double>::infinity()};
  }
  return mean_of_repeats(means_of_blocks(samples, block_rows));
}

std::vector<double> without_swing(std::span<const double> samples, std::size_t rows) {
  return running_mean(running_mean(samples, rows), rows);
}

UncertainMean steady_mean(std::span<const double> samples, double period_s) {
  if (samples.size() < kFewestSamples) {
    return {.standard_error = std::numeric_limits<double>::infinity()};
  }
  constexpr std::size_t kFewest = 4;
  constexpr std::size_t kMost = 40;
  const auto swing = static_cast<std::size_t>(std::lround(kSwing_s / period_s));
  const auto blocks = std::min(samples.size() / (2 * swing), kMost);
  std::vector<double> means;
  for (std::size_t block = 0; blocks >= kFewest && block < blocks; ++block) {
    const std::size_t first = block * samples.size() / blocks;
    const std::size_t last = (block + 1) * samples.size() / blocks;
    means.push_back(
        mean_of_repeats(without_swing(samples.subspan(first, last - first), swing)).value);
  }
  if (means.empty()) {
    means = means_of_blocks(samples, swing);
  }
  auto mean = mean_about_line(means);
  if (samples.size() > 2 * swing) {
    mean.value = mean_of_repeats(without_swing(samples, swing)).value;
  }
  return mean;
}

UncertainMean combine(double share_a, const UncertainMean& a, double share_b,
                      const UncertainMean& b) {
  const double variance_a = share_a * share_a * a.standard_error * a.standard_error;
  const double variance_b = share_b * share_b * b.standard_error * b.standard_error;
  const double variance = variance_a + variance_b;
  UncertainMean sum{.value = share_a * a.value + share_b * b.value,
                    .standard_error = std::sqrt(variance),
                    .degrees_of_freedom = a.degrees_of_freedom + b.degrees_of_freedom};
  const double doubt = variance_a * variance_a / std::max(a.degrees_of_freedom, 1.0) +
                       variance_b * variance_b / std::max(b.degrees_of_freedom, 1.0);
  if (doubt > 0) {
    sum.degrees_of_freedom = variance * variance / doubt;
  }
  return sum;
}

UncertainMean doubted(const UncertainMean& mean, double share, double degrees_of_freedom) {
  return combine(1.0, mean, 1.0,
                 {.value = 0,
                  .standard_error = std::fabs(mean.value * share),
                  .degrees_of_freedom = degrees_of_freedom});
}

double student_factor(double degrees_of_freedom) {
  constexpr double kUpper = 0.975;
  // Beyond this Student's t is the normal distribution to four digits.
  constexpr double kMany = 1e5;
  return boost::math::quantile(
      boost::math::students_t_distribution<double>(std::clamp(degrees_of_freedom, 1.0, kMany)),
      kUpper);
}

}  // namespace towbench::study::identify
