// Drag of one submerged body, (3.7), (3.8) and (8.1) as a vector in the tank plane:
//
//   F = -(D |v| + B_D) (v_forward e_forward + k v_left e_left)
//
// v: velocity in the tank, m/s; e: the body's frame at its yaw; k: across_drag_ratio. A round body
// (k = 1) is braked exactly against its motion. An elongated one (EXP-3) at an angle beta to its
// motion is braked along it by (D |v| + B_D) |v| (cos^2 beta + k sin^2 beta), and pushed sideways
// by (D |v| + B_D) |v| (k - 1) sin beta cos beta. Never does a body gain energy from water at rest.
#pragma once

#include "core/realtime.h"
#include "emulator/water/plane_vector.h"
#include "emulator/water/water_parameters.h"

namespace towbench::emulator {

class BodyDrag {
 public:
  // Out of the water: no drag.
  explicit BodyDrag(const WaterBodyParameters& body) noexcept
      : frame_(body.yaw_deg),
        quadratic_(body.in_water ? body.quadratic_drag_N_s2_per_m2 : 0.0),
        linear_(body.in_water ? body.linear_drag_N_s_per_m : 0.0),
        across_ratio_(body.across_drag_ratio) {}

  // N, at a velocity in m/s.
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector operator()(
      const PlaneVector& velocity) const noexcept;

 private:
  BodyFrame frame_;
  double quadratic_;
  double linear_;
  double across_ratio_;
};

}  // namespace towbench::emulator
