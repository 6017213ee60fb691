#include "emulator/plant/sine_table.h"

#include <numbers>

namespace towbench::emulator {

SineTable::SineTable() noexcept {
  constexpr double kWidth = 1.0 / kKnots;
  constexpr double kSlope = 2.0 * std::numbers::pi * kWidth;  // of an interval's own variable
  for (std::size_t i = 0; i < kKnots; ++i) {
    const core::SineCosine a = core::sine_cosine_of_turns(static_cast<double>(i) * kWidth);
    const core::SineCosine b = core::sine_cosine_of_turns(static_cast<double>(i + 1) * kWidth);
    const double d0 = kSlope * a.cosine;
    const double d1 = kSlope * b.cosine;
    const double rise = b.sine - a.sine;
    cubics_[i] = {a.sine, d0, 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise};
  }
}

}  // namespace towbench::emulator
