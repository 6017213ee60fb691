#include "emulator/plant/friction_law.h"

#include <limits>

#include "core/check.h"
#include "core/deterministic_math.h"

namespace towbench::emulator {
namespace {

// exp(-y^2), not a denormal or a rounding residue in the last interval.
double gaussian(double y) noexcept {
  return core::exponential(-y * y);
}

}  // namespace

StribeckCurve::StribeckCurve(StribeckForm form) noexcept : form_(form) {
  const double width = 1.0 / kKnotsPerUnit;
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const double y0 = static_cast<double>(i) * width;
    const double y1 = y0 + width;
    const double f0 = gaussian(y0);
    const double f1 = gaussian(y1);
    const double d0 = -2.0 * y0 * f0 * width;  // slopes over one interval: Hermite's form
    const double d1 = -2.0 * y1 * f1 * width;
    cubics_[i] = {f0, d0, 3.0 * (f1 - f0) - 2.0 * d0 - d1, 2.0 * (f0 - f1) + d0 + d1};
  }
}

PositionCurve::PositionCurve(const PositionFriction::Table& x, const PositionFriction::Table& f,
                             double scale) noexcept
    : present_(!x.empty()) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!present_) {
    add(-kInfinity, kInfinity, 0.0, 0.0, 0.0);
    return;
  }
  const std::size_t last = x.size() - 1;
  add(-kInfinity, x[0], x[0], f[0] * scale, 0.0);
  for (std::size_t i = 0; i < last; ++i) {
    add(x[i], x[i + 1], x[i], f[i] * scale, scale * (f[i + 1] - f[i]) / (x[i + 1] - x[i]));
  }
  add(x[last], kInfinity, x[last], f[last] * scale, 0.0);
}

void PositionCurve::add(double start_m, double end_m, double reference_m, double level,
                        double slope_per_m) noexcept {
  core::check(count_ < pieces_.size());
  pieces_[count_++] = {.start_m = start_m,
                       .end_m = end_m,
                       .reference_m = reference_m,
                       .level = level,
                       .slope_per_m = slope_per_m};
}

}  // namespace towbench::emulator
