// sin and its slope from a table: the tick path has no time for a full-precision sine, and needs
// none. Cubic Hermite between 256 knots a turn: good to h^4 / 384 = 1e-9, the slope to 1e-7. The
// slope is that of the cubic itself, so that a force taken from it conserves energy.
#pragma once

#include <array>
#include <cstddef>

#include "core/deterministic_math.h"

namespace towbench::emulator {

class SineTable {
 public:
  SineTable() noexcept;

  struct Value {
    double sine;
    double slope_per_turn;  // 2 pi cos
  };

  [[nodiscard, gnu::always_inline]] Value operator()(double turns) const noexcept {
    const double scaled = (turns - core::floor_exact(turns)) * kKnots;
    const auto knot = static_cast<std::size_t>(scaled);
    const double s = scaled - static_cast<double>(knot);
    const auto& c = cubics_[knot < kKnots ? knot : 0];  // a rounded-up fraction of 1 is 0
    return {c[0] + s * (c[1] + s * (c[2] + s * c[3])),
            kKnots * (c[1] + s * (2.0 * c[2] + s * (3.0 * c[3])))};
  }

 private:
  static constexpr std::size_t kKnots = 256;
  std::array<std::array<double, 4>, kKnots> cubics_{};
};

}  // namespace towbench::emulator
