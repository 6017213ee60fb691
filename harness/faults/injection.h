// A plan of faults as what makes them happen: events in the machine, a link that fails, a host that
// stalls; what is built differently from the start is in built_in_fault.h. The controller's code is
// never touched.
#pragma once

#include <vector>

#include "emulator/scheduled_event.h"
#include "harness/bench/host_schedule.h"
#include "harness/faults/case_record.h"
#include "harness/faults/fault.h"
#include "harness/faults/link_faults.h"

namespace towbench::harness {

// After a kill switch has welded somebody presses it.
inline constexpr core::Nanoseconds kHandComes_ns = 50 * core::kNanosecondsPerMillisecond;

struct Injection {
  bool over_can = false;                         // what a bus does to the data, too
  std::vector<emulator::ScheduledEvent> events;  // sorted by time
  std::vector<LinkFault> link;
  HostSchedule host;
};

// Adds one fault that begins at `at_ns`. `twin` is the run without it: where a contact is to bounce
// at its next edge, the twin knows when that is. `end_ns` is where the run ends at the latest.
void inject(const Fault& fault, core::Nanoseconds at_ns, const CaseRecord& twin,
            core::Nanoseconds end_ns, Injection& injection);
// Puts events in order; after the last inject().
void finish(Injection& injection);

}  // namespace towbench::harness
