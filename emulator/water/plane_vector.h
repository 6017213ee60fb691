// A vector in the tank plane by its components along the axes (X across, Y along, Z up), and the
// frame of a body that is turned in it.
#pragma once

#include <cmath>

#include "core/axis.h"
#include "core/deterministic_math.h"
#include "core/realtime.h"

namespace towbench::emulator {

using PlaneVector = core::PerAxis<double>;

// Components in a body's own frame.
struct BodyVector {
  double forward = 0;
  double left = 0;
};

// At yaw 0 forward is +Y and left is -X; yaw turns counter-clockwise seen from above.
class BodyFrame {
 public:
  explicit BodyFrame(double yaw_deg) noexcept
      : turn_(core::sine_cosine_of_turns(yaw_deg / 360.0)) {}

  TOWBENCH_REALTIME [[nodiscard]] BodyVector from_tank(const PlaneVector& v) const noexcept {
    const double x = v[core::Axis::kX];
    const double y = v[core::Axis::kY];
    return {.forward = turn_.cosine * y - turn_.sine * x,
            .left = -turn_.sine * y - turn_.cosine * x};
  }
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector to_tank(const BodyVector& v) const noexcept {
    PlaneVector tank;
    tank[core::Axis::kX] = -turn_.sine * v.forward - turn_.cosine * v.left;
    tank[core::Axis::kY] = turn_.cosine * v.forward - turn_.sine * v.left;
    return tank;
  }

 private:
  core::SineCosine turn_;
};

}  // namespace towbench::emulator
