#include "emulator/sensors/cubic_motion.h"

#include <cmath>

namespace towbench::emulator {

CubicMotion::TurningPoints CubicMotion::turning_points() const noexcept {
  TurningPoints points;
  // slope = 3 c u^2 + 2 q u + l. The form with a sum of equal signs loses no digits when c is tiny.
  const double discriminant = quadratic_ * quadratic_ - 3.0 * cubic_ * linear_;
  if (!(discriminant > 0.0)) {
    return points;
  }
  const double sum = -(quadratic_ + std::copysign(std::sqrt(discriminant), quadratic_));
  // Numerators and denominators apart: a root at infinity fails the comparison, never divides.
  const double first_denominator = 3.0 * cubic_;
  double roots[2] = {2.0, 2.0};
  if (std::fabs(sum) < std::fabs(first_denominator) && sum * first_denominator > 0.0) {
    roots[0] = sum / first_denominator;
  }
  if (std::fabs(linear_) < std::fabs(sum) && linear_ * sum > 0.0) {
    roots[1] = linear_ / sum;
  }
  const bool ascending = roots[0] <= roots[1];
  for (const double root : {ascending ? roots[0] : roots[1], ascending ? roots[1] : roots[0]}) {
    if (root < 1.0) {
      (void)points.push_back(root);
    }
  }
  return points;
}

double CubicMotion::reach(double target, double u_from, double u_to) const noexcept {
  constexpr double kTolerance = 1e-9;
  constexpr int kMaxIterations = 80;
  const double from_excess = displacement(u_from) - target;
  const double to_excess = displacement(u_to) - target;
  if (from_excess == 0.0 || to_excess == 0.0 || (from_excess > 0.0) == (to_excess > 0.0)) {
    return std::fabs(from_excess) <= std::fabs(to_excess) ? u_from : u_to;
  }
  const bool rising = to_excess > 0.0;
  double low = u_from;
  double high = u_to;
  double u = u_from + (u_to - u_from) * (from_excess / (from_excess - to_excess));
  // Newton inside a shrinking bracket: quadratic on smooth stretches, bisection near a reversal.
  for (int i = 0; i < kMaxIterations; ++i) {
    const double excess = displacement(u) - target;
    if (excess == 0.0) {
      return u;
    }
    ((excess > 0.0) == rising ? high : low) = u;
    const double gradient = slope(u);
    double next = gradient != 0.0 ? u - excess / gradient : low;
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    if (std::fabs(next - u) < kTolerance) {
      return next;
    }
    u = next;
  }
  return u;
}

}  // namespace towbench::emulator
