// Jerk-limited profile that leaves the chain mode alone.
//
// A trapezoid averaged over a sliding window T_j:
//
//   x_s(t) = (1/T_j) integral of x(s) ds over [t - T_j, t]
//
// The acceleration becomes trapezoidal, the jerk at most a_max / T_j, the duration T_j longer, and
// the spectrum of whatever the trapezoid excites is multiplied by sinc(f T_j): with T_j a
// whole number of periods of the chain mode (9 Hz: 111 ms, docs/reference/constants.md) that mode
// is left at rest, as far as it is undamped and its frequency known. Cf. Singer and Seering 1990,
// input shaping; Meckl and Seering 1985, pulse widths at multiples of the period.
#pragma once

#include "bbmc/system/trajectory/reference.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "core/result.h"

namespace towbench::bbmc {

class SCurve {
 public:
  // Window > 0 and finite, and whatever Trapezoid wants; kRequestBadArgument otherwise.
  [[nodiscard]] static core::Result<SCurve> make(const TrapezoidParameters& wanted,
                                                 double window_s) noexcept;

  [[nodiscard]] Reference at(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return base_.duration_s() + window_s_; }
  [[nodiscard]] double end_m() const noexcept { return base_.end_m(); }
  // Signed; a bound when the steady part is shorter than the window.
  [[nodiscard]] double peak_velocity_m_per_s() const noexcept {
    return base_.peak_velocity_m_per_s();
  }
  [[nodiscard]] double window_s() const noexcept { return window_s_; }

 private:
  explicit SCurve(const Trapezoid& base, double window_s) noexcept
      : base_(base), window_s_(window_s) {}

  Trapezoid base_;
  double window_s_;
};

}  // namespace towbench::bbmc
