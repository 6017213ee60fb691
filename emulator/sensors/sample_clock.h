// When a sensor takes a sample: at every whole multiple of its period, which is a whole number of
// plant ticks.
#pragma once

#include "core/time.h"

namespace towbench::emulator {

class SampleClock {
 public:
  explicit SampleClock(double period_s) noexcept : period_ns_(core::nanoseconds(period_s)) {}

  [[nodiscard]] bool due(core::Nanoseconds now_ns) noexcept {
    if (now_ns < next_ns_) {
      return false;
    }
    next_ns_ += period_ns_;
    return true;
  }

 private:
  core::Nanoseconds period_ns_;
  core::Nanoseconds next_ns_ = period_ns_;
};

}  // namespace towbench::emulator
