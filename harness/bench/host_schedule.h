// When the controller's host does not run the controller: a process that is stopped, ticks that
// come late or not at all. The machine goes on with what it was told last.
#pragma once

#include <algorithm>
#include <vector>

#include "core/time.h"

namespace towbench::harness {

struct HostStall {
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = 0;  // the first exchange at or after this is served again
};

struct HostSchedule {
  std::vector<HostStall> stalls;

  [[nodiscard]] bool serves_at(core::Nanoseconds time_ns) const noexcept {
    return std::none_of(stalls.begin(), stalls.end(), [&](const HostStall& stall) {
      return time_ns >= stall.from_ns && time_ns < stall.until_ns;
    });
  }
};

}  // namespace towbench::harness
