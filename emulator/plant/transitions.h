// How the regime changes: at the start of a step, when inputs may have jumped, and at an event.
#pragma once

#include "emulator/plant/guards.h"

namespace towbench::emulator {

// Brings the regime into line with the state and freshly changed inputs.
TOWBENCH_REALTIME void settle(const AxisModel& model, Situation& s, StateVector& z) noexcept;

// The regime after `event`; z is put exactly on the event's surface where rounding left it beside.
TOWBENCH_REALTIME void cross(const AxisModel& model, Event event, double sign, Situation& s,
                             StateVector& z) noexcept;

// The drive's part of it alone, for a step on which only the command changed.
TOWBENCH_REALTIME void settle_drive(const AxisModel& model, Situation& s, StateVector& z) noexcept;

}  // namespace towbench::emulator
