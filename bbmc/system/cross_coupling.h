// The error of a 2-D path that matters: across it (thesis 9.3.2). An error along the path is time,
// an error across it is shape, and each axis alone cannot tell one from the other.
//
//   e_n = e - (e . t) t,   t the reference's direction
//
// To first order in the error over the path's radius: 1 mm on 200 mm makes 2.5 um.
#pragma once

#include "bbmc/device/axes.h"
#include "bbmc/system/trajectory/reference.h"
#include "core/realtime.h"

namespace towbench::bbmc {

// m, in the axes' own frames. 0 while the reference is slower than 0.1 mm/s: no direction.
TOWBENCH_REALTIME [[nodiscard]] inline PerAxis<double> error_across_path_m(
    const PerAxis<Reference>& reference, const PerAxis<double>& error_m) noexcept {
  constexpr double kSlowest_m2_per_s2 = 1e-8;
  const double vy = reference[core::Axis::kY].velocity_m_per_s;
  const double vx = reference[core::Axis::kX].velocity_m_per_s;
  const double speed_squared = vy * vy + vx * vx;
  if (!(speed_squared > kSlowest_m2_per_s2)) {
    return {};
  }
  const double along =
      (error_m[core::Axis::kY] * vy + error_m[core::Axis::kX] * vx) / speed_squared;
  return {{error_m[core::Axis::kY] - along * vy, error_m[core::Axis::kX] - along * vx}};
}

}  // namespace towbench::bbmc
