#include "emulator/plant/linear_mode.h"

namespace towbench::emulator {
namespace {

constexpr std::size_t kAugmented = std::size_t{kStateCount} + std::size_t{kInputCount};

// Rough sizes of states and inputs, powers of two so that scaling by them is exact. They only
// balance the matrices before exponentials and norms are taken; results do not depend on them.
constexpr Column<kAugmented> kTypicalSize{1.0,    1.0, 0x1p7,  0x1p-3, 0x1p-10,
                                          0x1p-7, 1.0, 0x1p-5, 0x1p4};

// Above this the alternating terms of the series cancel more than three digits of sixteen.
constexpr double kLargestNorm = 14.0;

SquareMatrix<kAugmented> balanced(const ContinuousMode& mode, double tick_s) noexcept {
  SquareMatrix<kAugmented> m{};
  for (std::size_t column = 0; column < kAugmented; ++column) {
    for (std::size_t row = 0; row < kStateCount; ++row) {
      const double element =
          column < kStateCount ? mode.state[column][row] : mode.input[column - kStateCount][row];
      m[column][row] = tick_s * element * kTypicalSize[column] / kTypicalSize[row];
    }
  }
  return m;
}

// Terms after which |M|^k / k! is below rounding.
int terms_for(double norm) noexcept {
  double term = 1.0;
  int k = 0;
  while (term > 1e-17 && k < kMaxTaylorTerms) {
    ++k;
    term *= norm / k;
  }
  return k < 4 ? 4 : k;
}

}  // namespace

bool discretise(ContinuousMode& mode, double tick_s, DiscreteMode& out) noexcept {
  const SquareMatrix<kAugmented> m = balanced(mode, tick_s);
  const double norm = one_norm(m);
  if (!(norm <= kLargestNorm)) {
    return false;
  }
  mode.taylor_terms = terms_for(norm);
  const SquareMatrix<kAugmented> flow = exponential_of(m);
  for (std::size_t column = 0; column < kAugmented; ++column) {
    for (std::size_t row = 0; row < kStateCount; ++row) {
      const double element = flow[column][row] * kTypicalSize[row] / kTypicalSize[column];
      (column < kStateCount ? out.state[column][row] : out.input[column - kStateCount][row]) =
          element;
    }
  }
  return true;
}

}  // namespace towbench::emulator
