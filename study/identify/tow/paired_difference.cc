#include "study/identify/tow/paired_difference.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::identify {
namespace {

struct OneWay {
  UncertainMean mean;
  int spans = 0;
};

// Adds one span's mean to those of its direction.
void add(OneWay& way, const UncertainMean& mean) {
  ++way.spans;
  const double share = 1.0 / way.spans;
  way.mean = way.spans == 1 ? mean : combine(1.0 - share, way.mean, share, mean);
}

std::optional<DragPoint> average(const OneWay& there, const OneWay& back, double speed) {
  if (there.spans == 0 || back.spans != there.spans) {
    return std::nullopt;
  }
  return DragPoint{.speed_m_per_s = speed, .force_N = combine(0.5, there.mean, 0.5, back.mean)};
}

}  // namespace

std::size_t block_rows(const Recording& recording) noexcept {
  constexpr double kBlock_s = 0.2;
  return static_cast<std::size_t>(std::lround(kBlock_s / recording.period_s));
}

std::optional<DragPoint> paired_difference(const Recording& with,
                                           std::span<const double> column_with,
                                           const Recording& without,
                                           std::span<const double> column_without, core::Axis axis,
                                           double scale, double settle_s) {
  const auto spans_with = steady_spans(with, axis, settle_s);
  const auto spans_without = steady_spans(without, axis, settle_s);
  if (spans_with.size() != spans_without.size() || column_with.empty() || column_without.empty()) {
    return std::nullopt;
  }
  OneWay there;
  OneWay back;
  double speed = 0;
  for (std::size_t k = 0; k < spans_with.size(); ++k) {
    const auto& a = spans_with[k];
    const auto& b = spans_without[k];
    const std::size_t rows = std::min(a.rows(), b.rows());
    if (a.direction() != b.direction()) {
      return std::nullopt;
    }
    std::vector<double> difference(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      difference[i] =
          a.direction() * scale * (column_with[a.first + i] - column_without[b.first + i]);
    }
    add(a.direction() > 0 ? there : back, steady_mean(difference, with.period_s));
    speed += std::fabs(a.speed_m_per_s) / static_cast<double>(spans_with.size());
  }
  return average(there, back, speed);
}

std::optional<DragPoint> both_ways(const Recording& recording, std::span<const double> column,
                                   core::Axis axis, double scale, double settle_s) {
  const auto spans = steady_spans(recording, axis, settle_s);
  OneWay there;
  OneWay back;
  double speed = 0;
  for (const auto& span : spans) {
    if (column.empty()) {
      return std::nullopt;
    }
    std::vector<double> signed_rows(span.rows());
    for (std::size_t i = 0; i < span.rows(); ++i) {
      signed_rows[i] = span.direction() * scale * column[span.first + i];
    }
    add(span.direction() > 0 ? there : back, steady_mean(signed_rows, recording.period_s));
    speed += std::fabs(span.speed_m_per_s) / static_cast<double>(spans.size());
  }
  return average(there, back, speed);
}

}  // namespace towbench::study::identify
