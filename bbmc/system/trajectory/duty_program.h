// Open-loop duty of one axis over time, whatever its shape: a value, without heap.
#pragma once

#include <type_traits>
#include <variant>

#include "bbmc/system/trajectory/prbs_program.h"
#include "bbmc/system/trajectory/pulse_program.h"
#include "bbmc/system/trajectory/sine_program.h"
#include "bbmc/system/trajectory/steps_program.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class DutyProgram {
 public:
  using Shape =
      std::variant<PulseProgram, BreakAwayProgram, StepsProgram, SineProgram, PrbsProgram>;

  // No pulse, no duration.
  DutyProgram() noexcept = default;
  template <typename T>
  requires std::is_constructible_v<Shape, const T&>
  // A planner's result is a program; the conversion is the point.
  DutyProgram(const T& shape)
  noexcept : shape_(shape) {}  // NOLINT(google-explicit-constructor)

  // % of full drive, + towards max; 0 before 0 and after duration_s().
  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept {
    return std::visit([time_s](const auto& shape) { return shape.duty_pct(time_s); }, shape_);
  }
  [[nodiscard]] double duration_s() const noexcept {
    return std::visit([](const auto& shape) { return shape.duration_s(); }, shape_);
  }

 private:
  Shape shape_;
};

static_assert(std::is_trivially_copyable_v<DutyProgram>);

}  // namespace towbench::bbmc
