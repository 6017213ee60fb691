// Torque at which an axis breaks away, read off ramps of duty.
//
// The thesis takes the last torque before motion (4.1.2). With an elastic transmission the motor
// creeps while the transmission is being stretched, so motion is when the speed passes a threshold.
// The level that started it is an earlier one, since just above break-away an axis gathers speed
// slowly: the first one by whose end the motor had not come to rest. Break-away lies between that
// level and the one before it, anywhere: the middle of the two is taken.
#pragma once

#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct BreakAway {
  double position_m = 0;
  double duty_pct = 0;  // signed
  double step_pct = 0;  // between the two levels
};

// One a stretch of open-loop duty that ended in motion. `threshold_m_per_s`: faster is motion.
[[nodiscard]] std::vector<BreakAway> find_break_aways(const Recording& data, core::Axis axis,
                                                      double threshold_m_per_s);

}  // namespace towbench::study::identify
