// Which event ends a regime first, and when.
#pragma once

#include "emulator/plant/guards.h"
#include "emulator/plant/taylor_flow.h"

namespace towbench::emulator {

// Nothing found: the flow stays inside the regime to its end.
struct Crossing {
  Event event = Event::kMotorStops;
  double sign = 0;
  double fraction = 1.0;  // of the flow's span
  bool found = false;
};

// The margin that turns negative first along the flow. Margins are looked at in the middle and at
// the end: what dips below zero and comes back within half a tick is taken for rounding.
TOWBENCH_REALTIME [[nodiscard]] Crossing first_event(const AxisModel& model, const Situation& s,
                                                     const TaylorFlow& flow) noexcept;

}  // namespace towbench::emulator
