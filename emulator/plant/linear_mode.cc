#include "emulator/plant/linear_mode.h"

#include <cmath>

namespace towbench::emulator {
namespace {

constexpr std::size_t kAugmented = std::size_t{kStateCount} + std::size_t{kInputCount};

// Above this the alternating terms of the series cancel more than three digits of sixteen.
constexpr double kLargestNorm = 14.0;

struct Balanced {
  SquareMatrix<kAugmented> matrix{};  // D^-1 h [A B; 0 0] D
  Column<kAugmented> scale{};         // the diagonal of D
};

SquareMatrix<kAugmented> augmented(const ContinuousMode& mode, double tick_s) noexcept {
  SquareMatrix<kAugmented> m{};
  for (std::size_t column = 0; column < kAugmented; ++column) {
    for (std::size_t row = 0; row < kStateCount; ++row) {
      m[column][row] = tick_s * (column < kStateCount ? mode.state[column][row]
                                                      : mode.input[column - kStateCount][row]);
    }
  }
  return m;
}

// The power of two by which row i must shrink and column i grow for the two to be of one size.
// Inputs have no row, and states that stand have none: their column alone is brought below one, of
// states only where `standing_too`.
double balancing_factor(const SquareMatrix<kAugmented>& m, std::size_t i,
                        bool standing_too) noexcept {
  double column = 0;
  double row = 0;
  for (std::size_t k = 0; k < kAugmented; ++k) {
    column += k == i ? 0.0 : std::fabs(m[i][k]);
    row += k == i ? 0.0 : std::fabs(m[k][i]);
  }
  double factor = 1.0;
  const bool is_state = i < kStateCount;
  if (column == 0 || (is_state && row == 0 && !standing_too)) {
    return factor;
  }
  const bool has_row = is_state && row != 0;
  const auto out_of_balance = [&](double f) { return has_row ? column * f * f / row : column * f; };
  constexpr int kMostDoublings = 80;
  for (int n = 0; n < kMostDoublings && out_of_balance(factor) > 2.0; ++n) {
    factor *= 0.5;
  }
  for (int n = 0; n < kMostDoublings && out_of_balance(factor) < 0.5; ++n) {
    factor *= 2.0;
  }
  return factor;
}

// Osborne's balancing by powers of two: exact, and it leaves the exponential what it is. Amperes,
// metres and radians otherwise differ so much that a norm says nothing.
Balanced balanced(const ContinuousMode& mode, double tick_s, bool standing_too) noexcept {
  Balanced b{.matrix = augmented(mode, tick_s)};
  b.scale.fill(1.0);
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < kAugmented; ++i) {
      const double factor = balancing_factor(b.matrix, i, standing_too);
      b.scale[i] *= factor;
      for (std::size_t k = 0; k < kAugmented; ++k) {
        b.matrix[i][k] *= factor;
        b.matrix[k][i] /= factor;
      }
    }
  }
  return b;
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
  Balanced balance = balanced(mode, tick_s, false);
  if (!(one_norm(balance.matrix) <= kLargestNorm)) {
    balance = balanced(mode, tick_s, true);
  }
  const double norm = one_norm(balance.matrix);
  if (!(norm <= kLargestNorm)) {
    return false;
  }
  mode.taylor_terms = terms_for(norm);
  const SquareMatrix<kAugmented> flow = exponential_of(balance.matrix);
  for (std::size_t column = 0; column < kAugmented; ++column) {
    for (std::size_t row = 0; row < kStateCount; ++row) {
      const double element = flow[column][row] * balance.scale[row] / balance.scale[column];
      (column < kStateCount ? out.state[column][row] : out.input[column - kStateCount][row]) =
          element;
    }
  }
  return true;
}

}  // namespace towbench::emulator
