// What happens in the controller that is worth a line in a record.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/error.h"
#include "core/time.h"

namespace towbench::bbmc {

struct SystemEvent {
  core::Nanoseconds time_ns = 0;
  enum class Kind : std::uint8_t {
    kStateChanged,  // value: the new AxisMode
    kFaultLatched,  // code
    kReset,
    kMotionStarted,
    kMotionEnded,  // code: kNone when it ran to its end
    kDutyZeroed,   // code: why
    kLineEdge,     // value: +(index of the line + 1) active, negative inactive; time of the edge
    kLogFull,
    kPeerLost,
  } kind = Kind::kStateChanged;
  core::Axis axis = core::Axis::kY;
  core::ErrorCode code = core::ErrorCode::kNone;
  std::int64_t value = 0;
};

}  // namespace towbench::bbmc
