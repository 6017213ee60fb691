#include "study/procedures/steady_speeds.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::procedures {

std::vector<double> speeds_up_to(double top) {
  std::vector<double> speeds;
  for (int i = 1; i <= 10; ++i) {
    speeds.push_back(1e-3 * i);
  }
  for (int i = 2; i <= 10; ++i) {
    speeds.push_back(1e-2 * i);
  }
  for (int i = 2; i <= 4; ++i) {
    speeds.push_back(1e-1 * i);
  }
  while (!speeds.empty() && speeds.back() > top) {
    speeds.pop_back();
  }
  return speeds;
}

bool sticks(const identify::Recording& data, core::Axis axis, std::size_t from, std::size_t to,
            double speed) {
  // Over 20 counts of way or 20 ms, whichever is longer, the speed stays within a third.
  const double span_s = std::max(0.02, 20 * data.metres_per_count[axis] / speed);
  const auto span = static_cast<std::size_t>(std::lround(span_s / data.period_s));
  for (std::size_t k = from + span; k < to; k += span / 2 + 1) {
    const double v = std::fabs(data.position_m(axis, k) - data.position_m(axis, k - span)) /
                     (data.time_s[k] - data.time_s[k - span]);
    if (std::fabs(v / speed - 1) > 0.35) {
      return true;
    }
  }
  return false;
}

}  // namespace towbench::study::procedures
