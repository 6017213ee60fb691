#include "study/procedures/tow/tracking_errors.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::procedures {

TrackingErrors tracking_errors(const identify::Recording& run, core::Axis axis, std::size_t first,
                               std::size_t last) {
  const auto& log = run.axes[axis];
  TrackingErrors errors;
  for (std::size_t i = first; i < last; ++i) {
    if (log.mode[i] != identify::kFollowsReference) {
      continue;
    }
    const double error = log.reference_m[i] - run.position_m(axis, i);
    errors.mean_m += error;
    errors.mean_abs_m += std::fabs(error);
    errors.rms_m += error * error;
    errors.peak_m = std::max(errors.peak_m, std::fabs(error));
    errors.speed_mean_abs_m_per_s +=
        std::fabs(log.reference_velocity_m_per_s[i] - log.velocity_m_per_s[i]);
    ++errors.rows;
  }
  if (errors.rows > 0) {
    const auto n = static_cast<double>(errors.rows);
    errors.mean_m /= n;
    errors.mean_abs_m /= n;
    errors.rms_m = std::sqrt(errors.rms_m / n);
    errors.speed_mean_abs_m_per_s /= n;
  }
  return errors;
}

}  // namespace towbench::study::procedures
