// Newtons at the carriage a percent of duty: n/R K_T K_amp V_PWM of (8.5), gear losses included.
//
// Found by a known weight: two runs of one motion, in one of which a weight over a pulley pulls at
// the load for a while. The force sensor weighs it, the duty answers it; the ratio of the two
// changes is the scale. What the run does before the weight pulls takes off both sensors' constant
// errors, the reference run takes off whatever depends on the place.
#pragma once

#include <optional>

#include "study/identify/recording.h"
#include "study/identify/tow/block_mean.h"

namespace towbench::study::identify {

// N / %, of an axis.
struct DriveScale {
  double force_per_duty_N = 0;
  double standard_error_N = 0;
  double degrees_of_freedom = 0;  // behind `standard_error_N`
};

struct PullTimes {
  double before_from_s = 0;  // steady motion, no weight
  double before_to_s = 0;
  double pulled_from_s = 0;  // the same motion, weight on and settled
  double pulled_to_s = 0;
};

// Empty when a recording lacks those times or the sensor, or the weight moved neither signal.
[[nodiscard]] std::optional<DriveScale> drive_scale(const Recording& pulled, const Recording& plain,
                                                    core::Axis axis, const PullTimes& times);

}  // namespace towbench::study::identify
