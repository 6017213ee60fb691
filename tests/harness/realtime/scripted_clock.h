// A clock that stands still until somebody sleeps or works, and wakes as late as the test says.
#pragma once

#include "harness/realtime/tick_clock.h"

namespace towbench::harness {

class ScriptedClock final : public TickClock {
 public:
  [[nodiscard]] core::Nanoseconds now_ns() noexcept override { return time_ns; }
  void sleep_until(core::Nanoseconds until_ns) noexcept override {
    if (until_ns > time_ns) {
      time_ns = until_ns;
    }
    time_ns += next_wake_late_ns;
    next_wake_late_ns = 0;
  }

  core::Nanoseconds time_ns = 0;
  core::Nanoseconds next_wake_late_ns = 0;
};

}  // namespace towbench::harness
