#include "harness/realtime/tick_clock.h"

#include <cerrno>
#include <ctime>

namespace towbench::harness {

core::Nanoseconds HostTickClock::now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * core::kNanosecondsPerSecond + now.tv_nsec;
}

void HostTickClock::sleep_until(core::Nanoseconds time_ns) noexcept {
  const timespec until{time_ns / core::kNanosecondsPerSecond,
                       time_ns % core::kNanosecondsPerSecond};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace towbench::harness
