#include "bbmc/system/trajectory/s_curve.h"

#include <cmath>

namespace towbench::bbmc {

core::Result<SCurve> SCurve::make(const TrapezoidParameters& wanted, double window_s) noexcept {
  const core::Result<Trapezoid> base = Trapezoid::make(wanted);
  if (!base) {
    return core::failure(base.error());
  }
  if (!std::isfinite(window_s) || window_s <= 0) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  return SCurve(*base, window_s);
}

Reference SCurve::at(double time_s) const noexcept {
  if (time_s <= 0) {
    return {.position_m = base_.at(0).position_m};
  }
  if (time_s >= duration_s()) {
    return {.position_m = base_.end_m()};
  }
  const double from_s = time_s - window_s_;
  const Reference newest = base_.at(time_s);
  const Reference oldest = base_.at(from_s);
  return {
      .position_m =
          (base_.position_integral_m_s(time_s) - base_.position_integral_m_s(from_s)) / window_s_,
      .velocity_m_per_s = (newest.position_m - oldest.position_m) / window_s_,
      .acceleration_m_per_s2 = (newest.velocity_m_per_s - oldest.velocity_m_per_s) / window_s_};
}

}  // namespace towbench::bbmc
