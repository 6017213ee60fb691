#include "emulator/water/body_drag.h"

namespace towbench::emulator {

PlaneVector BodyDrag::operator()(const PlaneVector& velocity) const noexcept {
  const BodyVector v = frame_.from_tank(velocity);
  const double speed = std::sqrt(v.forward * v.forward + v.left * v.left);
  const double slope_N_s_per_m = quadratic_ * speed + linear_;
  return frame_.to_tank(
      {.forward = -slope_N_s_per_m * v.forward, .left = -slope_N_s_per_m * across_ratio_ * v.left});
}

}  // namespace towbench::emulator
