// When the controller's host fails the controller: its process is stopped, its clock steps, its
// disk is full, it is killed. The machine goes on with what it was told last.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/time.h"

namespace towbench::harness {

struct HostStall {
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = 0;  // the first exchange at or after this is served again
};

// The controller is told a time that is `step_ns` later than the bench's (earlier when negative).
struct ClockStep {
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = 0;
  core::Nanoseconds step_ns = 0;
};

struct FullDisk {
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = 0;
};

struct HostSchedule {
  std::vector<HostStall> stalls;
  std::vector<ClockStep> steps;
  std::vector<FullDisk> full_disks;
  std::optional<core::Nanoseconds> killed_ns;

  [[nodiscard]] bool serves_at(core::Nanoseconds time_ns) const noexcept {
    return std::none_of(stalls.begin(), stalls.end(), [&](const HostStall& stall) {
      return time_ns >= stall.from_ns && time_ns < stall.until_ns;
    });
  }
  // The first moment from then on at which the host runs.
  [[nodiscard]] core::Nanoseconds next_served_ns(core::Nanoseconds time_ns) const noexcept {
    for (const HostStall& stall : stalls) {
      if (time_ns >= stall.from_ns && time_ns < stall.until_ns) {
        return stall.until_ns;
      }
    }
    return time_ns;
  }
  // By how much the controller's clock is ahead.
  [[nodiscard]] core::Nanoseconds ahead_ns(core::Nanoseconds time_ns) const noexcept {
    core::Nanoseconds ahead = 0;
    for (const ClockStep& step : steps) {
      ahead += time_ns >= step.from_ns && time_ns < step.until_ns ? step.step_ns : 0;
    }
    return ahead;
  }
  // Whether control ticks may be missing between two that were computed.
  [[nodiscard]] bool may_miss_ticks(core::Nanoseconds from_ns,
                                    core::Nanoseconds to_ns) const noexcept {
    const auto overlap = [&](core::Nanoseconds begin, core::Nanoseconds end) {
      return begin <= to_ns && end >= from_ns;
    };
    // A clock that goes back keeps the next tick waiting for as long.
    return std::any_of(
               stalls.begin(), stalls.end(),
               [&](const HostStall& stall) { return overlap(stall.from_ns, stall.until_ns); }) ||
           std::any_of(steps.begin(), steps.end(), [&](const ClockStep& step) {
             const auto length_ns = step.step_ns < 0 ? -step.step_ns : step.step_ns;
             return overlap(step.from_ns, step.from_ns + length_ns) ||
                    overlap(step.until_ns, step.until_ns + length_ns);
           });
  }
};

}  // namespace towbench::harness
