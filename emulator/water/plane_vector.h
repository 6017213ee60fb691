// A vector in the tank plane by its components along the axes (X across, Y along, Z up), and the
// frame of a body that is turned in it.
#pragma once

#include <cmath>

#include "core/axis.h"
#include "core/deterministic_math.h"
#include "core/realtime.h"

namespace towbench::emulator {

using PlaneVector = core::PerPlanarAxis<double>;

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

// Turns a vector about Z, counter-clockwise seen from above, and back.
class PlaneTurn {
 public:
  explicit PlaneTurn(double turns) noexcept : turn_(core::sine_cosine_of_turns(turns)) {}

  TOWBENCH_REALTIME [[nodiscard]] PlaneVector of(const PlaneVector& v) const noexcept {
    return turned(v, turn_.sine);
  }
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector back(const PlaneVector& v) const noexcept {
    return turned(v, -turn_.sine);
  }

 private:
  [[nodiscard]] PlaneVector turned(const PlaneVector& v, double sine) const noexcept {
    const double x = v[core::Axis::kX];
    const double y = v[core::Axis::kY];
    PlaneVector turned;
    turned[core::Axis::kX] = turn_.cosine * x - sine * y;
    turned[core::Axis::kY] = sine * x + turn_.cosine * y;
    return turned;
  }

  core::SineCosine turn_;
};

}  // namespace towbench::emulator
