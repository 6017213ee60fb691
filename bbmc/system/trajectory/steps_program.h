// Open-loop duty in steps, each held for its time: one step, or the double step of BBMC's rmpi.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/realtime.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

struct DutyStep {
  double duty_pct = 0;  // signed, 0 allowed
  double time_s = 0;    // > 0
};

class StepsProgram {
 public:
  static constexpr std::size_t kMaxSteps = 4;

  // One to kMaxSteps steps; kRequestBadArgument otherwise, or for a value out of its range.
  [[nodiscard]] static core::Result<StepsProgram> make(std::span<const DutyStep> steps) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return core::seconds(ends_ns_[size_ - 1]); }

 private:
  std::array<double, kMaxSteps> duty_pct_{};
  std::array<core::Nanoseconds, kMaxSteps> ends_ns_{};
  std::size_t size_ = 1;
};

}  // namespace towbench::bbmc
