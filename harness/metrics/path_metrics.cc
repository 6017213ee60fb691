#include "harness/metrics/path_metrics.h"

#include <algorithm>
#include <cmath>

#include "harness/metrics/statistics.h"
#include "harness/metrics/tracking_metrics.h"

namespace towbench::harness {
namespace {

struct Point {
  double x_m = 0;
  double y_m = 0;
};

struct PathSample {
  std::size_t log_row = 0;
  Point actual;
  // Whether the window holds it. The path it is measured against reaches beyond the window.
  bool judged = false;
};

// Within this many control ticks the nearest point of the reference is looked for: at 1 kHz a lag
// of 0.1 s either way, a hundred times what a useful loop shows, and short enough that another lap
// is never taken for this one.
constexpr std::size_t kReach_rows = 100;

double squared_distance_to_segment_m2(Point point, Point a, Point b) {
  const double along_x_m = b.x_m - a.x_m;
  const double along_y_m = b.y_m - a.y_m;
  const double length_squared_m2 = along_x_m * along_x_m + along_y_m * along_y_m;
  double share = 0;
  if (length_squared_m2 > 0) {
    share = ((point.x_m - a.x_m) * along_x_m + (point.y_m - a.y_m) * along_y_m) / length_squared_m2;
    share = std::clamp(share, 0.0, 1.0);
  }
  const double off_x_m = point.x_m - (a.x_m + share * along_x_m);
  const double off_y_m = point.y_m - (a.y_m + share * along_y_m);
  return off_x_m * off_x_m + off_y_m * off_y_m;
}

MetricValue peak_distance(const RunData& data, const std::vector<PathSample>& samples) {
  const auto reference_x_m = data.log_of(core::Axis::kX, "reference_m");
  const auto reference_y_m = data.log_of(core::Axis::kY, "reference_m");
  const auto reference = [&](std::size_t row) {
    return Point{reference_x_m[row], reference_y_m[row]};
  };
  Statistics statistics;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].judged) {
      continue;
    }
    const std::size_t from = i > kReach_rows ? i - kReach_rows : 0;
    const std::size_t to = std::min(samples.size() - 1, i + kReach_rows);
    const Point actual = samples[i].actual;
    const Point own = reference(samples[i].log_row);
    double nearest_m2 = squared_distance_to_segment_m2(actual, own, own);
    for (std::size_t j = from; j < to; ++j) {
      // Two samples that are not neighbours in the log belong to two motions: no path joins them.
      if (samples[j + 1].log_row == samples[j].log_row + 1) {
        nearest_m2 = std::min(nearest_m2,
                              squared_distance_to_segment_m2(actual, reference(samples[j].log_row),
                                                             reference(samples[j + 1].log_row)));
      }
    }
    statistics.add(std::sqrt(nearest_m2));
  }
  return statistics.peak();
}

}  // namespace

MetricValue path_error_peak(const RunData& data, core::Axis /*axis*/, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto state_y = data.log_of(core::Axis::kY, "state");
  const auto state_x = data.log_of(core::Axis::kX, "state");
  const auto position_y_m = data.log_of(core::Axis::kY, "position_m");
  const auto position_x_m = data.log_of(core::Axis::kX, "position_m");
  std::vector<PathSample> samples;
  if (state_x.empty() || state_y.empty() || position_x_m.empty() || position_y_m.empty()) {
    return {};
  }
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (state_y[i] == kStatePosition && state_x[i] == kStatePosition) {
      samples.push_back({i, {position_x_m[i], position_y_m[i]}, span.holds(time_s[i])});
    }
  }
  return peak_distance(data, samples);
}

MetricValue carriage_path_error_peak(const RunData& data, core::Axis /*axis*/,
                                     const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto along_y = carriage_samples(data, core::Axis::kY, {});
  const auto along_x = carriage_samples(data, core::Axis::kX, {});
  std::vector<PathSample> samples;
  for (auto y = along_y.begin(), x = along_x.begin(); y != along_y.end() && x != along_x.end();) {
    if (y->log_row == x->log_row) {
      samples.push_back(
          {y->log_row, {x->carriage_m, y->carriage_m}, span.holds(time_s[y->log_row])});
      ++y;
      ++x;
    } else if (y->log_row < x->log_row) {
      ++y;
    } else {
      ++x;
    }
  }
  return peak_distance(data, samples);
}

}  // namespace towbench::harness
