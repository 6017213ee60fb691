#include "harness/report/controller_frame.h"

#include <cmath>
#include <limits>

#include "bbmc/system/telemetry_row.h"

namespace towbench::harness::report {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr auto kIdle = static_cast<double>(bbmc::AxisMode::kIdle);
constexpr auto kFollowing = static_cast<double>(bbmc::AxisMode::kPosition);

}  // namespace

std::vector<double> count_origins(const std::vector<double>& count,
                                  const std::vector<double>& true_count,
                                  const std::vector<double>* state) {
  std::vector<double> origins(count.size(), kMissing);
  double origin = kMissing;
  bool was_following = false;
  for (std::size_t row = 0; row < count.size(); ++row) {
    const double here = count[row] - true_count[row];
    const bool following = state == nullptr || (*state)[row] == kFollowing;
    const bool idle = state != nullptr && (*state)[row] == kIdle;
    if (!std::isnan(here) && (std::isnan(origin) || idle || (following && !was_following))) {
      origin = here;
    }
    was_following = following;
    origins[row] = origin;
  }
  return origins;
}

std::size_t first_row_of_frame(const std::vector<double>& origins, const std::vector<double>& state,
                               double metres_per_count) {
  std::size_t first = 0;
  for (std::size_t row = 1; row < origins.size() && state[row - 1] == kIdle; ++row) {
    if (std::fabs(origins[row] - origins[row - 1]) * metres_per_count > kFrameTolerance_m) {
      first = row;
    }
  }
  return first;
}

}  // namespace towbench::harness::report
