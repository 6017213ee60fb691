// The reference of one axis over time, whatever its shape: a value, without heap, so that it can
// pass a queue.
#pragma once

#include <type_traits>
#include <variant>

#include "bbmc/system/trajectory/chain.h"
#include "bbmc/system/trajectory/harmonic.h"
#include "bbmc/system/trajectory/hold.h"
#include "bbmc/system/trajectory/reference.h"
#include "bbmc/system/trajectory/s_curve.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class Trajectory {
 public:
  using Shape = std::variant<Hold, Trapezoid, SCurve, Harmonic, Chain>;

  Trajectory() noexcept = default;
  template <typename T>
  requires std::is_constructible_v<Shape, const T&>
  // A planner's result is a trajectory; the conversion is the point.
  Trajectory(const T& shape)
  noexcept : shape_(shape) {}  // NOLINT(google-explicit-constructor)

  // Time from the start of the motion; the shape rests before 0 and after duration_s().
  TOWBENCH_REALTIME [[nodiscard]] Reference at(double time_s) const noexcept {
    return std::visit([time_s](const auto& shape) { return shape.at(time_s); }, shape_);
  }
  [[nodiscard]] double duration_s() const noexcept {
    return std::visit([](const auto& shape) { return shape.duration_s(); }, shape_);
  }

 private:
  Shape shape_;
};

static_assert(std::is_trivially_copyable_v<Trajectory>);

}  // namespace towbench::bbmc
