// Tracking of one run in words of Tables 7.6 and 8.3: motor side, from the log.
#pragma once

#include <cstddef>

#include "study/identify/recording.h"

namespace towbench::study::procedures {

// Rows in which the axis follows a reference, in [first, last).
struct TrackingErrors {
  double mean_m = 0;  // signed
  double mean_abs_m = 0;
  double rms_m = 0;
  double peak_m = 0;
  double speed_mean_abs_m_per_s = 0;  // of the controller's own estimate against the reference
  std::size_t rows = 0;
};

[[nodiscard]] TrackingErrors tracking_errors(const identify::Recording& run, core::Axis axis,
                                             std::size_t first, std::size_t last);
[[nodiscard]] inline TrackingErrors tracking_errors(const identify::Recording& run,
                                                    core::Axis axis) {
  return tracking_errors(run, axis, 0, run.rows());
}

}  // namespace towbench::study::procedures
