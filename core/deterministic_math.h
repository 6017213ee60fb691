// The few transcendental functions of the tick path, with the same bits on every machine.
//
// libm differs between C libraries and processors; these use IEEE-754 +, -, *, / only, in a fixed
// order (the tree is compiled with -ffp-contract=off).
#pragma once

namespace towbench::core {

struct SineCosine {
  double sine;
  double cosine;
};

// sin and cos of 2 pi `turns`. |turns| < 2^51; absolute error below 3e-16 plus that of `turns`.
// Turns, not radians: the reduction to one quadrant is then exact.
[[nodiscard]] SineCosine sine_cosine_of_turns(double turns) noexcept;

// e^x, relative error below 4e-16. 0 below -708, and the value at 709 above it.
[[nodiscard]] double exponential(double x) noexcept;

// The largest integer not above x, as a double. |x| < 2^51.
[[nodiscard]] constexpr double floor_exact(double x) noexcept {
  const double truncated = static_cast<double>(static_cast<long long>(x));
  return truncated > x ? truncated - 1.0 : truncated;
}

}  // namespace towbench::core
