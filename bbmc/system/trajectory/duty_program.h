// Open-loop duty of one axis over time, whatever its shape: a value, without heap. A rest without
// drive may follow, in which the axis coasts, as BBMC 0.5 let it: an axis that still moves when the
// program is over is braked, and that is no part of the response to be identified.
#pragma once

#include <type_traits>
#include <variant>

#include "bbmc/system/trajectory/prbs_program.h"
#include "bbmc/system/trajectory/program_time.h"
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
  // rest_s >= 0; anything else is no rest.
  DutyProgram(const T& shape, double rest_s = 0)  // NOLINT(google-explicit-constructor)
  noexcept
      : shape_(shape),
        shape_ns_(whole_nanoseconds(shape.duration_s())),
        rest_ns_(is_time(rest_s) ? core::nanoseconds(rest_s) : 0) {}

  // % of full drive, + towards max; 0 before 0, in the rest, and after duration_s().
  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept {
    if (!(time_s >= 0) || whole_nanoseconds(time_s) >= shape_ns_) {
      return 0;
    }
    return std::visit([time_s](const auto& shape) { return shape.duty_pct(time_s); }, shape_);
  }
  [[nodiscard]] double duration_s() const noexcept { return core::seconds(shape_ns_ + rest_ns_); }

 private:
  Shape shape_;
  core::Nanoseconds shape_ns_ = 0;
  core::Nanoseconds rest_ns_ = 0;
};

static_assert(std::is_trivially_copyable_v<DutyProgram>);

}  // namespace towbench::bbmc
