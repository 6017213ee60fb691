// What an experiment makes happen to the machine, each at its own nanosecond.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/realtime.h"
#include "emulator/faults/scheduled_event.h"
#include "emulator/plant_node.h"
#include "emulator/rig.h"

namespace towbench::emulator {

class EventScript {
 public:
  // Sorted by time. Events before the start of the run fire in its first tick.
  explicit EventScript(std::span<const ScheduledEvent> events)
      : events_(events.begin(), events.end()) {}

  // One that nobody had planned, behind those of the same time. Not from real-time code.
  void add(const ScheduledEvent& event);

  // Before a tick of the rig: fires what falls into it. When the operator's reset did, the last one
  // of them, or none.
  TOWBENCH_REALTIME std::optional<core::Nanoseconds> fire_due(Rig& rig,
                                                              PlantObserver& observer) noexcept;

 private:
  std::vector<ScheduledEvent> events_;
  std::size_t next_ = 0;
};

}  // namespace towbench::emulator
