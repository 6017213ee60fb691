// One coordinate over one stretch of time as the cubic Hermite polynomial between its ends, and
// where inside the stretch it reaches a value. Used to place edges inside the 100 us step.
//
// Positions are any unit (counts, m); time is the normalised u in [0, 1] of the stretch.
#pragma once

#include <cmath>

#include "core/bounded_vector.h"
#include "core/realtime.h"

namespace towbench::emulator {

class CubicMotion {
 public:
  // Rates are per second, the stretch lasts `duration_s` > 0.
  TOWBENCH_REALTIME CubicMotion(double duration_s, double start, double start_rate, double end,
                                double end_rate) noexcept
      : linear_(start_rate * duration_s),
        quadratic_(3.0 * (end - start) - (2.0 * start_rate + end_rate) * duration_s),
        cubic_((start_rate + end_rate) * duration_s - 2.0 * (end - start)) {}

  // Displacement from the start. Relative, so that no digits drown in a large position.
  TOWBENCH_REALTIME [[nodiscard]] double displacement(double u) const noexcept {
    return u * (linear_ + u * (quadratic_ + u * cubic_));
  }
  TOWBENCH_REALTIME [[nodiscard]] double slope(double u) const noexcept {
    return linear_ + u * (2.0 * quadratic_ + u * (3.0 * cubic_));
  }

  // Bound of how much the slope changes and curves over the stretch: 2 |Q| + 6 |C|.
  TOWBENCH_REALTIME [[nodiscard]] double bend() const noexcept {
    return 2.0 * std::fabs(quadratic_) + 6.0 * std::fabs(cubic_);
  }

  // Where the motion reverses strictly inside the stretch, ascending: none, one or two.
  using TurningPoints = core::BoundedVector<double, 2>;
  TOWBENCH_REALTIME [[nodiscard]] TurningPoints turning_points() const noexcept;

  // The u in [u_from, u_to] at which displacement(u) = target, for a stretch that is monotone there
  // and brackets the target; clamped to the nearer end when rounding puts it just outside.
  // Error below 1e-9 of the stretch (0.1 ps of a step) or the position's last digit.
  TOWBENCH_REALTIME [[nodiscard]] double reach(double target, double u_from,
                                               double u_to) const noexcept;

 private:
  double linear_;
  double quadratic_;
  double cubic_;
};

}  // namespace towbench::emulator
