// A hand on the machine at a set time: what an experiment file may make happen on the plant's side.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/time.h"
#include "emulator/sensors/wire_condition.h"
#include "protocol/messages.h"

namespace towbench::emulator {

enum class ScheduledEventKind : std::uint8_t {
  kPressKillSwitch,
  kReleaseKillSwitch,
  kPushCarriage,        // external force of `value` N on the axis's load from now on
  kRewireInput,         // `input_line` gets `condition`
  kRewireEncoder,       // `encoder_line` of the axis gets `condition`
  kSwapEncoderChannels  // A and B of the axis swapped (`value` != 0) or put right
};

struct ScheduledEvent {
  core::Nanoseconds time_ns = 0;
  ScheduledEventKind kind = ScheduledEventKind::kPressKillSwitch;
  core::Axis axis = core::Axis::kY;
  double value = 0;
  protocol::InputLine input_line = protocol::InputLine::kKillSwitch;
  protocol::EncoderLine encoder_line = protocol::EncoderLine::kA;
  WireCondition condition = WireCondition::kIntact;
};

}  // namespace towbench::emulator
