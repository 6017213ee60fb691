// The inverse of a cubic motion that hardly changes speed: when is a displacement reached, without
// a division or an iteration per edge.
//
// u(s) is interpolated by the cubic Hermite polynomial through both ends with slopes 1 / x'. With
// e = (2|Q| + 6|C|) / min |x'| (the relative change of speed and slope over the stretch; x = L u +
// Q u^2 + C u^3) the interpolation errs by at most (10 e^2 + 15 e^3) / 384 of the stretch, from the
// fourth derivative of the inverse: 0.3 ns of 100 us at e = 0.01. Above that one step of Newton's
// method with the slope of the interpolant follows, which leaves 0.3 ns up to e = 0.1.
#pragma once

#include <cmath>

#include "core/realtime.h"
#include "emulator/sensors/cubic_motion.h"

namespace towbench::emulator {

class GentleInverse {
 public:
  // Valid for stretches that are `gentle` only.
  TOWBENCH_REALTIME GentleInverse(const CubicMotion& motion, double displacement) noexcept
      : motion_(motion), scale_(1.0 / displacement) {
    const double start_slope = displacement / motion.slope(0.0);
    const double end_slope = displacement / motion.slope(1.0);
    linear_ = start_slope;
    quadratic_ = 3.0 - 2.0 * start_slope - end_slope;
    cubic_ = start_slope + end_slope - 2.0;
  }

  // Relative change of speed over the stretch; large when the motion may reverse.
  TOWBENCH_REALTIME [[nodiscard]] static bool gentle(const CubicMotion& motion,
                                                     double tolerance) noexcept {
    const double start = motion.slope(0.0);
    const double end = motion.slope(1.0);
    const double slowest = std::fabs(start) < std::fabs(end) ? std::fabs(start) : std::fabs(end);
    return start * end > 0.0 && motion.bend() < tolerance * slowest;
  }
  static constexpr double kGentle = 0.1;
  static constexpr double kVeryGentle = 0.01;

  // The u at which the motion has moved by `target`.
  TOWBENCH_REALTIME [[nodiscard]] double plain(double target) const noexcept {
    const double share = target * scale_;
    return share * (linear_ + share * (quadratic_ + share * cubic_));
  }
  TOWBENCH_REALTIME [[nodiscard]] double corrected(double target) const noexcept {
    const double share = target * scale_;
    const double u = share * (linear_ + share * (quadratic_ + share * cubic_));
    const double slope = linear_ + share * (2.0 * quadratic_ + share * (3.0 * cubic_));
    return u + (target - motion_.displacement(u)) * (slope * scale_);
  }

 private:
  CubicMotion motion_;
  double scale_;
  double linear_;
  double quadratic_;
  double cubic_;
};

}  // namespace towbench::emulator
