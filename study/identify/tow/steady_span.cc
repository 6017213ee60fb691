#include "study/identify/tow/steady_span.h"

#include <cmath>

namespace towbench::study::identify {
namespace {

constexpr double kShortest_s = 0.3;
// Far below what a ramp changes in a row, far above rounding.
constexpr double kSameSpeed = 1e-6;

}  // namespace

std::vector<SteadySpan> steady_spans(const Recording& recording, core::Axis axis, double settle_s) {
  const auto& log = recording.axes[axis];
  const auto settle_rows = static_cast<std::size_t>(std::lround(settle_s / recording.period_s));
  const auto fewest_rows = static_cast<std::size_t>(std::lround(kShortest_s / recording.period_s));
  std::vector<SteadySpan> spans;
  std::size_t row = 0;
  while (row < recording.rows()) {
    const double speed = log.reference_velocity_m_per_s[row];
    std::size_t end = row + 1;
    if (speed != 0 && log.mode[row] == kFollowsReference) {
      while (end < recording.rows() && log.mode[end] == kFollowsReference &&
             std::fabs(log.reference_velocity_m_per_s[end] - speed) <=
                 kSameSpeed * std::fabs(speed)) {
        ++end;
      }
    }
    if (end - row >= settle_rows + fewest_rows) {
      SteadySpan span{.first = row + settle_rows, .last = end};
      span.speed_m_per_s =
          (recording.position_m(axis, end - 1) - recording.position_m(axis, span.first)) /
          (static_cast<double>(span.rows() - 1) * recording.period_s);
      span.from_m = log.reference_m[span.first];
      span.to_m = log.reference_m[end - 1];
      spans.push_back(span);
    }
    row = end;
  }
  return spans;
}

}  // namespace towbench::study::identify
