// Who wants to know how far a run has come.
#pragma once

#include "core/time.h"

namespace towbench::harness {

class TimeWatcher {
 public:
  TimeWatcher() = default;
  TimeWatcher(const TimeWatcher&) = delete;
  TimeWatcher& operator=(const TimeWatcher&) = delete;
  virtual ~TimeWatcher() = default;
  // The plant is about to run to `until_ns`.
  virtual void runs_to(core::Nanoseconds until_ns) noexcept = 0;
};

}  // namespace towbench::harness
