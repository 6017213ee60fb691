// The swing of the carriage on its transmission, from what the force sensor feels after a load was
// changed at once (a weight over a pulley) during a steady tow.
//
// The load hangs below the carriage, x, so the sensor feels -m x'' beside the new load; and
//
//   x'' = -w^2 (x - x_m) - d (x - x_m)' + constant
//
// with the motor's own place x_m from the encoder: how the controller lets the motor give way is no
// part of w. By least squares: for each w and d the swing that x_m excites is simulated, and the
// free swing, m and the sensor's zero are linear. w is that of a motor that is held.
#pragma once

#include <optional>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct TransmissionSwing {
  double rate_rad_per_s = 0;  // w
  double standard_error = 0;  // of `rate_rad_per_s`
  double damping_per_s = 0;   // d
};

// Where the load has changed and the carriage no longer reverses, until little of the swing is
// left. Empty when the times are not in the recording, there is no force sensor, or no swing is
// seen.
[[nodiscard]] std::optional<TransmissionSwing> transmission_swing(const Recording& run,
                                                                  core::Axis axis, double from_s,
                                                                  double to_s);

}  // namespace towbench::study::identify
