#include "core/deterministic_math.h"

#include <bit>
#include <cstdint>
#include <numbers>

namespace towbench::core {
namespace {

// Taylor coefficients in z = (2 pi r)^2 for |r| <= 1/8 turn; the first term left out is below
// 1e-19.
double sine_of_octant(double angle_rad) noexcept {
  const double z = angle_rad * angle_rad;
  double sum = 1.0 / 355687428096000.0;
  sum = -1.0 / 1307674368000.0 + z * sum;
  sum = 1.0 / 6227020800.0 + z * sum;
  sum = -1.0 / 39916800.0 + z * sum;
  sum = 1.0 / 362880.0 + z * sum;
  sum = -1.0 / 5040.0 + z * sum;
  sum = 1.0 / 120.0 + z * sum;
  sum = -1.0 / 6.0 + z * sum;
  return angle_rad + angle_rad * (z * sum);
}

double cosine_of_octant(double angle_rad) noexcept {
  const double z = angle_rad * angle_rad;
  double sum = -1.0 / 6402373705728000.0;
  sum = 1.0 / 20922789888000.0 + z * sum;
  sum = -1.0 / 87178291200.0 + z * sum;
  sum = 1.0 / 479001600.0 + z * sum;
  sum = -1.0 / 3628800.0 + z * sum;
  sum = 1.0 / 40320.0 + z * sum;
  sum = -1.0 / 720.0 + z * sum;
  sum = 1.0 / 24.0 + z * sum;
  return 1.0 - (0.5 * z - z * z * sum);
}

}  // namespace

SineCosine sine_cosine_of_turns(double turns) noexcept {
  const double quarters = floor_exact(4.0 * turns + 0.5);
  const double rest_rad = (turns - 0.25 * quarters) * (2.0 * std::numbers::pi);
  const double s = sine_of_octant(rest_rad);
  const double c = cosine_of_octant(rest_rad);
  switch (static_cast<std::uint64_t>(static_cast<std::int64_t>(quarters)) & 3U) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double exponential(double x) noexcept {
  if (x < -708.0) {
    return 0.0;
  }
  x = x > 709.0 ? 709.0 : x;
  // x = k ln 2 + r with ln 2 split in two, so that k ln 2 is exact to twice the precision.
  constexpr double kLn2High = 6.93147180369123816490e-01;
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  const double k = floor_exact(x * std::numbers::log2e + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  // Taylor to r^13 / 13!; |r| < 0.347, so the first term left out is below 5e-18.
  double sum = 1.0;
  for (int n = 13; n >= 1; --n) {
    sum = 1.0 + r * sum / n;
  }
  const auto exponent = static_cast<std::int64_t>(k) + 1023;
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(exponent) << 52U);
}

}  // namespace towbench::core
