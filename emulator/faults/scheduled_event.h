// Something that happens to the machine at a set time: a hand on it, or a part of it that fails.
// What an experiment file or a fault plan may make happen on the plant's side.
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
  kPushCarriage,         // external force of `value` N on the axis's load from now on
  kRewireInput,          // `input_line` gets `condition`
  kRewireEncoder,        // `encoder_line` of the axis gets `condition`
  kSwapEncoderChannels,  // A and B of the axis swapped (`value` != 0) or put right
  kCrossInputs,          // wires of `input_line` and `other_line` exchanged, or put right again
  // Amplifier and command (emulator/faults/axis_faults.h); 0, 1 or infinity put them right.
  kAmplifierOff,  // `value` != 0: no output whatever is commanded
  kHoldCommand,   // `value` != 0: the command stays what it is now
  kScaleCommand,  // command times `value`
  kLimitCommand,  // command within +-`value` V
  kShortBridge,   // `value` != 0: both PWM channels active, which drives nothing
  kLoadSupply,    // somebody else draws `value` W
  kSagSupply,     // open-circuit voltage lower by `value` V
  // Carriage: forces from outside the drive.
  kJamCarriage,   // `value` != 0: held where it is
  kDragCarriage,  // brakes with `value` N
  kObstacle,      // a stop `value` m ahead (signed: towards max or min); 0: gone
  kDropLoad,      // lighter by `value` kg
  // Holding brake; nothing on an axis without one.
  kStickBrake,  // `value` != 0: its coil is dead, it closes
  kLoseBrake,   // `value` != 0: does not hold
  // Encoder disc on its shaft (emulator/faults/slipping_disc.h).
  kSlipDisc,  // stands still for the next `value` counts of the shaft
  kTurnDisc,  // jumps by `value` counts
  // What an absolute encoder tells.
  kHoldAbsolute,  // `value` != 0: the same from now on, wherever the axis goes
  // Teeth of the transmission.
  kSkipTooth,  // jumps: the motor has turned further, by `value` m at the load, without moving the
               // carriage
  // The operator, to the controller.
  kReset,  // leave the safe state
};

struct ScheduledEvent {
  core::Nanoseconds time_ns = 0;
  ScheduledEventKind kind = ScheduledEventKind::kPressKillSwitch;
  core::Axis axis = core::kFirstAxis;
  double value = 0;
  protocol::InputLine input_line = protocol::InputLine::kKillSwitch;
  protocol::InputLine other_line = protocol::InputLine::kKillSwitch;
  protocol::EncoderLine encoder_line = protocol::EncoderLine::kA;
  WireCondition condition = WireCondition::kIntact;
};

}  // namespace towbench::emulator
