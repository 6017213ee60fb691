#include "emulator/plant/friction_law.h"

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

PositionFrictionCurve::PositionFrictionCurve(const PositionFriction& table, double scale) noexcept
    : position_m_(table.position_m) {
  for (std::size_t i = 0; i < table.friction_Nm.size(); ++i) {
    core::check(level_.push_back(table.friction_Nm[i] * scale));
  }
  for (std::size_t i = 0; i + 1 < level_.size(); ++i) {
    core::check(slope_per_m_.push_back((level_[i + 1] - level_[i]) /
                                       (position_m_[i + 1] - position_m_[i])));
  }
}

double PositionFrictionCurve::operator()(double carriage_m) const noexcept {
  const std::size_t knots = position_m_.size();
  if (knots == 0) {
    return 0.0;
  }
  if (!(carriage_m > position_m_[0])) {
    return level_[0];
  }
  for (std::size_t i = 0; i + 1 < knots; ++i) {
    if (carriage_m < position_m_[i + 1]) {
      return level_[i] + slope_per_m_[i] * (carriage_m - position_m_[i]);
    }
  }
  return level_[knots - 1];
}

}  // namespace towbench::emulator
