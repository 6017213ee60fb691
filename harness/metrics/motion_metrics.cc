#include "harness/metrics/motion_metrics.h"

#include <algorithm>
#include <cmath>

#include "harness/metrics/statistics.h"

namespace towbench::harness {
namespace {

constexpr double kSameMoment_s = 1e-9;

Statistics over(std::span<const double> time_s, std::span<const double> values,
                const TimeSpan& span) {
  Statistics statistics;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (span.holds(time_s[i])) {
      statistics.add(values[i]);
    }
  }
  return statistics;
}

}  // namespace

MetricValue duty_peak(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return over(data.log.column("time_s"), data.log_of(axis, "duty_pct"), span).peak();
}

MetricValue duty_saturated_share(const RunData& data, core::Axis axis, const TimeSpan& span) {
  constexpr double kLimit_pct = 99.9;
  const auto time_s = data.log.column("time_s");
  const auto duty_pct = data.log_of(axis, "duty_pct");
  Statistics share;
  for (std::size_t i = 0; i < duty_pct.size(); ++i) {
    if (span.holds(time_s[i])) {
      share.add(std::fabs(duty_pct[i]) >= kLimit_pct ? 1.0 : 0.0);
    }
  }
  return share.mean();
}

MetricValue duty_ripple(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto duty_pct = data.log_of(axis, "duty_pct");
  Statistics change;
  for (std::size_t i = 1; i < duty_pct.size(); ++i) {
    if (span.holds(time_s[i])) {
      change.add(duty_pct[i] - duty_pct[i - 1]);
    }
  }
  return change.rms();
}

MetricValue carriage_speed_peak(const RunData& data, core::Axis axis, const TimeSpan& span) {
  return over(data.truth.column("time_s"), data.truth_of(axis, "carriage_speed_m_per_s"), span)
      .peak();
}

MetricValue carriage_travel(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.truth.column("time_s");
  const auto carriage_m = data.truth_of(axis, "carriage_m");
  double lowest_m = 0;
  double highest_m = 0;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < carriage_m.size(); ++i) {
    if (span.holds(time_s[i])) {
      lowest_m = samples == 0 ? carriage_m[i] : std::min(lowest_m, carriage_m[i]);
      highest_m = samples == 0 ? carriage_m[i] : std::max(highest_m, carriage_m[i]);
      ++samples;
    }
  }
  return {highest_m - lowest_m, samples};
}

MetricValue edges_total(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto edges = data.log_of(axis, "edges");
  MetricValue total;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (span.holds(time_s[i])) {
      total.value += edges[i];
      ++total.samples;
    }
  }
  return total;
}

MetricValue edges_missed(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto log_time_s = data.log.column("time_s");
  const auto truth_time_s = data.truth.column("time_s");
  const auto edges = data.log_of(axis, "edges");
  const auto sent = data.truth_of(axis, "edges_total");
  MetricValue missed;
  double seen = 0;
  std::size_t truth_row = 0;
  for (std::size_t i = 0; i < edges.size() && log_time_s[i] <= span.to_s; ++i) {
    seen += edges[i];
    while (truth_row < sent.size() && truth_time_s[truth_row] < log_time_s[i] - kSameMoment_s) {
      ++truth_row;
    }
    if (truth_row < sent.size() &&
        std::fabs(truth_time_s[truth_row] - log_time_s[i]) <= kSameMoment_s) {
      missed = {sent[truth_row] - seen, missed.samples + 1};
    }
  }
  return missed;
}

}  // namespace towbench::harness
