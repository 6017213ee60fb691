#include "harness/metrics/tracking_metrics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/metrics/statistics.h"

namespace towbench::harness {
namespace {

constexpr double kSameRow_s = 1e-9;

Statistics tracking_error(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto state = data.log_of(axis, "state");
  const auto reference_m = data.log_of(axis, "reference_m");
  const auto position_m = data.log_of(axis, "position_m");
  Statistics statistics;
  if (state.empty() || reference_m.empty() || position_m.empty()) {
    return statistics;
  }
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (span.holds(time_s[i]) && state[i] == kStatePosition) {
      statistics.add(reference_m[i] - position_m[i]);
    }
  }
  return statistics;
}

Statistics carriage_error(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto reference_m = data.log_of(axis, "reference_m");
  Statistics statistics;
  for (const auto& sample : carriage_samples(data, axis, span)) {
    statistics.add(reference_m[sample.log_row] - sample.carriage_m);
  }
  return statistics;
}

// What is left to the place where the reference stays: before it, positive, in the direction of the
// reference's last change.
struct Approach {
  std::vector<double> time_s;  // from that change on
  std::vector<double> left_m;
};

Approach approach(const RunData& data, core::Axis axis, const TimeSpan& span) {
  constexpr double kChange_m = 1e-9;
  const auto time_s = data.log.column("time_s");
  const auto state = data.log_of(axis, "state");
  const auto reference_m = data.log_of(axis, "reference_m");
  const auto position_m = data.log_of(axis, "position_m");
  Approach way;
  double direction = 0;
  std::optional<double> before_m;
  std::vector<double> position_after_m;
  for (std::size_t i = 0; i < std::min(reference_m.size(), position_m.size()); ++i) {
    if (!span.holds(time_s[i]) || state[i] != kStatePosition) {
      continue;
    }
    const double change_m = reference_m[i] - before_m.value_or(reference_m[i]);
    before_m = reference_m[i];
    if (std::fabs(change_m) > kChange_m) {
      direction = change_m > 0 ? 1 : -1;
      way.time_s.clear();
      position_after_m.clear();
    }
    if (direction != 0) {
      way.time_s.push_back(time_s[i]);
      position_after_m.push_back(position_m[i]);
    }
  }
  for (const double place_m : position_after_m) {
    way.left_m.push_back(direction * (*before_m - place_m));
  }
  return way;
}

}  // namespace

std::vector<CarriageSample> carriage_samples(const RunData& data, core::Axis axis,
                                             const TimeSpan& span) {
  const auto log_time_s = data.log.column("time_s");
  const auto truth_time_s = data.truth.column("time_s");
  const auto state = data.log_of(axis, "state");
  const auto count = data.log_of(axis, "count");
  const auto true_count = data.truth_of(axis, "count");
  const auto carriage_m = data.truth_of(axis, "carriage_m");
  std::vector<CarriageSample> samples;
  if (state.empty() || count.empty() || true_count.empty() || carriage_m.empty()) {
    return samples;
  }
  double origin_counts = 0;
  bool following = false;
  std::size_t truth_row = 0;
  for (std::size_t i = 0; i < log_time_s.size(); ++i) {
    while (truth_row < truth_time_s.size() &&
           truth_time_s[truth_row] < log_time_s[i] - kSameRow_s) {
      ++truth_row;
    }
    const bool matched = truth_row < truth_time_s.size() &&
                         std::fabs(truth_time_s[truth_row] - log_time_s[i]) <= kSameRow_s;
    if (state[i] != kStatePosition || !matched) {
      following = following && state[i] == kStatePosition;
      continue;
    }
    if (!following) {
      origin_counts = count[i] - true_count[truth_row];
      following = true;
    }
    if (span.holds(log_time_s[i])) {
      samples.push_back(
          {i, carriage_m[truth_row] + origin_counts * data.limits[axis].metres_per_count});
    }
  }
  return samples;
}

MetricValue tracking_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return tracking_error(data, axis, span).peak();
}
MetricValue tracking_error_rms(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return tracking_error(data, axis, span).rms();
}
MetricValue tracking_error_mean(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return tracking_error(data, axis, span).mean();
}
MetricValue final_error(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto state = data.log_of(axis, "state");
  const auto reference_m = data.log_of(axis, "reference_m");
  const auto position_m = data.log_of(axis, "position_m");
  MetricValue last;
  for (std::size_t i = 0; i < std::min(reference_m.size(), position_m.size()); ++i) {
    if (span.holds(time_s[i]) && state[i] == kStatePosition) {
      last = {std::fabs(reference_m[i] - position_m[i]), last.samples + 1};
    }
  }
  return last;
}
MetricValue overshoot(const RunData& data, core::Axis axis, const TimeSpan& span) {
  Statistics beyond;
  for (const double left_m : approach(data, axis, span).left_m) {
    beyond.add(left_m > 0 ? 0 : left_m);  // what is no number spoils the whole
  }
  return beyond.peak();
}
MetricValue settling_time(const RunData& data, core::Axis axis, const TimeSpan& span) {
  constexpr double kSettled_m = 1e-4;  // assumed: half of what a final error may be
  const auto way = approach(data, axis, span);
  std::size_t settled = way.left_m.size();
  while (settled > 0 && std::fabs(way.left_m[settled - 1]) <= kSettled_m) {
    --settled;
  }
  return settled == way.left_m.size()
             ? MetricValue{}
             : MetricValue{way.time_s[settled] - way.time_s.front(), way.left_m.size()};
}
MetricValue carriage_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return carriage_error(data, axis, span).peak();
}
MetricValue carriage_error_rms(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return carriage_error(data, axis, span).rms();
}

}  // namespace towbench::harness
