// The clock that a real-time loop runs by, injected so that tests decide what the host does.
#pragma once

#include "core/time.h"

namespace towbench::harness {

class TickClock {
 public:
  TickClock() = default;
  TickClock(const TickClock&) = delete;
  TickClock& operator=(const TickClock&) = delete;
  virtual ~TickClock() = default;
  // Monotonic, from an origin of its own.
  [[nodiscard]] virtual core::Nanoseconds now_ns() noexcept = 0;
  // Returns at `time_ns` or later; at once when that is past.
  virtual void sleep_until(core::Nanoseconds time_ns) noexcept = 0;
};

// CLOCK_MONOTONIC, absolute sleeps: what a tick costs does not shift the next one.
class HostTickClock final : public TickClock {
 public:
  [[nodiscard]] core::Nanoseconds now_ns() noexcept override;
  void sleep_until(core::Nanoseconds time_ns) noexcept override;
};

}  // namespace towbench::harness
