// A hand on the machine at a set time: what an experiment file may make happen on the plant's side.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/time.h"

namespace towbench::emulator {

enum class ScheduledEventKind : std::uint8_t {
  kPressKillSwitch,
  kReleaseKillSwitch,
  kPushCarriage,  // external force of `value` N on the axis from now on
};

struct ScheduledEvent {
  core::Nanoseconds time_ns = 0;
  ScheduledEventKind kind = ScheduledEventKind::kPressKillSwitch;
  core::Axis axis = core::Axis::kY;
  double value = 0;
};

}  // namespace towbench::emulator
