// Times of open-loop programs in whole nanoseconds: an edge falls on its control tick at every
// rate, and not on the next one because 0.1 + 0.2 is not 0.3.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/time.h"

namespace towbench::bbmc {

inline constexpr double kLongestProgram_s = 86'400;

// Not NaN, not longer than a day, so that whole nanoseconds hold it with room to spare.
[[nodiscard]] inline bool is_time(double time_s) noexcept {
  return time_s >= 0 && time_s <= kLongestProgram_s;
}

[[nodiscard]] inline bool is_duty(double duty_pct) noexcept {
  return std::fabs(duty_pct) > 0 && std::fabs(duty_pct) <= 100;
}

// Clamped, so that no time a caller may name overflows.
[[nodiscard]] inline core::Nanoseconds whole_nanoseconds(double time_s) noexcept {
  return time_s > 0 ? core::nanoseconds(std::min(time_s, 1e4 * kLongestProgram_s)) : 0;
}

}  // namespace towbench::bbmc
