// What makes faults happen: events in the machine, a link that fails, a host that stalls; what is
// built differently from the start is in built_in_fault.h.
#pragma once

#include <vector>

#include "emulator/faults/scheduled_event.h"
#include "harness/link/link_faults.h"
#include "harness/lockstep/host_schedule.h"

namespace towbench::harness {

// After a kill switch has welded somebody presses it.
inline constexpr core::Nanoseconds kOperatorReaction_ns = 50 * core::kNanosecondsPerMillisecond;

struct Injection {
  bool over_can = false;                         // what a bus does to the data, too
  std::vector<emulator::ScheduledEvent> events;  // sorted by time
  std::vector<LinkFault> link;
  HostSchedule host;
};

}  // namespace towbench::harness
