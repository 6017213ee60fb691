// Stretches of a recording in which an axis runs at a steady speed under constant duty.
#pragma once

#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct Plateau {
  double speed_m_per_s = 0;       // signed; slope of a straight line through the counts
  double half_width_m_per_s = 0;  // 95 %, from blocks of the line's residual
  double middle_m = 0;
  double slope_m_per_s2 = 0;  // how far from steady
};

// The last part of each stretch of |duty| = `duty_pct`, where the speed changes by less than 0.5 %
// over it. A stretch that never gets there gives none.
[[nodiscard]] std::vector<Plateau> find_plateaus(const Recording& data, core::Axis axis,
                                                 double duty_pct);

}  // namespace towbench::study::identify
