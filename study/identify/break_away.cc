#include "study/identify/break_away.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::identify {
namespace {

constexpr std::uint8_t kOpenLoop = 1;  // bbmc::AxisMode
constexpr double kOnsetShare = 0.2;    // of the threshold: already more than creep
constexpr std::int64_t kStirs = 3;     // counts: more than a standing encoder dithers by

// In m/s over 20 ms that end at row k.
double speed_at(const Recording& data, core::Axis axis, std::size_t from, std::size_t k) {
  const auto span = static_cast<std::size_t>(std::lround(0.02 / data.period_s));
  const std::size_t before = k > from + span ? k - span : from;
  const double time_s = data.time_s[k] - data.time_s[before];
  return time_s > 0 ? (data.position_m(axis, k) - data.position_m(axis, before)) / time_s : 0;
}

// The last row of the level before that of row k; `from` when the ramp began with it.
std::size_t end_of_level_before(const AxisRecording& columns, std::size_t from, std::size_t k) {
  const double level = columns.duty_pct[k];
  while (k > from && columns.duty_pct[k] == level) {
    --k;
  }
  return k;
}

// Whether the motor still moved in the last third of the level that ends with row `last`. A
// transmission that was stretched by the step has come to rest by then.
bool stirs_at_the_end(const AxisRecording& columns, std::size_t from, std::size_t last) {
  const std::size_t before = end_of_level_before(columns, from, last);
  const std::size_t third = (last - before) / 3;
  const auto moved = columns.count[last] - columns.count[last - third];
  return (columns.duty_pct[last] < 0 ? -moved : moved) >= kStirs;
}

}  // namespace

std::vector<BreakAway> find_break_aways(const Recording& data, core::Axis axis,
                                        double threshold_m_per_s) {
  std::vector<BreakAway> found;
  const auto& columns = data.axes[axis];
  for (std::size_t k = 0; k < data.rows();) {
    if (columns.mode[k] != kOpenLoop) {
      ++k;
      continue;
    }
    const std::size_t from = k;
    while (k < data.rows() && columns.mode[k] == kOpenLoop) {
      ++k;
    }
    const std::size_t last = k - 1;
    // A light axis passes the threshold within the span of the mean, which is then far below it.
    if (std::fabs(speed_at(data, axis, from, last)) < kOnsetShare * threshold_m_per_s) {
      continue;  // gave up without moving
    }
    std::size_t onset = last;
    while (onset > from &&
           std::fabs(speed_at(data, axis, from, onset)) > kOnsetShare * threshold_m_per_s) {
      --onset;
    }
    std::size_t before = end_of_level_before(columns, from, onset);
    while (before > from && stirs_at_the_end(columns, from, before)) {
      onset = before;
      before = end_of_level_before(columns, from, onset);
    }
    const double level = columns.duty_pct[onset];
    const double below = columns.duty_pct[before];
    found.push_back({.position_m = data.position_m(axis, onset),
                     .duty_pct = 0.5 * (level + below),
                     .step_pct = std::fabs(level - below)});
  }
  return found;
}

}  // namespace towbench::study::identify
