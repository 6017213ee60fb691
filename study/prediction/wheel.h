// A wheel out of round, or a polygon of links on it: the load goes (1 + excess) times as far as the
// motor, excess = a cos(2 pi f x) + b sin(2 pi f x).
#pragma once

#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {

struct Wheel {
  double excess = 0;
  double ahead_m = 0;      // the load of the motor: the integral of the excess
  double slope_per_m = 0;  // of the excess
};

// With the motor at `x_m`; all zero where the axis has none.
[[nodiscard]] Wheel wheel_at(const Parameters& p, double x_m) noexcept;

// What a rigid axis resists by it, in newtons at the motor: with r = 1 + excess the load's inertia
// and dry friction, M (r^2 a + r r' v^2) + r C (virtual work), beside those of r = 1.
[[nodiscard]] double rigid_wheel_N(const Parameters& p, double x_m, double v_m_per_s,
                                   double a_m_per_s2) noexcept;

}  // namespace towbench::study::diagnose
