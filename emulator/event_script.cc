#include "emulator/event_script.h"

#include <algorithm>

namespace towbench::emulator {
namespace {

[[nodiscard]] bool rewire_encoder(Rig& rig, const ScheduledEvent& event,
                                  std::uint32_t in_tick_ns) noexcept {
  RigAxis* axis = rig.axis(event.axis);
  if (axis == nullptr) {
    return true;  // no such wires
  }
  return event.kind == ScheduledEventKind::kRewireEncoder
             ? axis->wiring().set_line(event.encoder_line, event.condition, in_tick_ns)
             : axis->wiring().swap_channels(event.value != 0.0, in_tick_ns);
}

[[nodiscard]] bool fail_axis(Rig& rig, const ScheduledEvent& event) noexcept {
  if (RigAxis* axis = rig.axis(event.axis)) {
    axis->fail(event.kind, event.value);
  }
  return true;
}

// False when this tick has no room for it: the next one takes it.
[[nodiscard]] bool fire(Rig& rig, const ScheduledEvent& event, core::Nanoseconds time_ns) noexcept {
  switch (event.kind) {
    case ScheduledEventKind::kPressKillSwitch:
      return rig.set_kill_switch(true, time_ns);
    case ScheduledEventKind::kReleaseKillSwitch:
      return rig.set_kill_switch(false, time_ns);
    case ScheduledEventKind::kPushCarriage:
      rig.push_carriage(event.axis, event.value, time_ns);
      return true;
    case ScheduledEventKind::kRewireInput:
      return rig.input_wiring().set_line(event.input_line, event.condition, time_ns);
    case ScheduledEventKind::kCrossInputs:
      return rig.input_wiring().cross(event.input_line, event.other_line, time_ns);
    case ScheduledEventKind::kRewireEncoder:
    case ScheduledEventKind::kSwapEncoderChannels:
      return rewire_encoder(rig, event, static_cast<std::uint32_t>(time_ns - rig.now_ns()));
    case ScheduledEventKind::kLoadSupply:
      rig.supply().load(event.value);
      return true;
    case ScheduledEventKind::kSagSupply:
      rig.supply().sag(event.value);
      return true;
    case ScheduledEventKind::kAmplifierOff:
    case ScheduledEventKind::kHoldCommand:
    case ScheduledEventKind::kScaleCommand:
    case ScheduledEventKind::kLimitCommand:
    case ScheduledEventKind::kShortBridge:
    case ScheduledEventKind::kJamCarriage:
    case ScheduledEventKind::kDragCarriage:
    case ScheduledEventKind::kObstacle:
    case ScheduledEventKind::kDropLoad:
    case ScheduledEventKind::kStickBrake:
    case ScheduledEventKind::kLoseBrake:
    case ScheduledEventKind::kSlipDisc:
    case ScheduledEventKind::kTurnDisc:
    case ScheduledEventKind::kHoldAbsolute:
    case ScheduledEventKind::kSkipTooth:
      return fail_axis(rig, event);
    case ScheduledEventKind::kReset:
      return true;  // the machine takes no part in it
  }
  return true;
}

}  // namespace

void EventScript::add(const ScheduledEvent& event) {
  const auto to_come = events_.begin() + static_cast<std::ptrdiff_t>(next_);
  events_.insert(
      std::upper_bound(to_come, events_.end(), event,
                       [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; }),
      event);
}

std::optional<core::Nanoseconds> EventScript::fire_due(Rig& rig, PlantObserver& observer) noexcept {
  std::optional<core::Nanoseconds> reset_ns;
  const core::Nanoseconds start_ns = rig.now_ns();
  const core::Nanoseconds end_ns = start_ns + core::kPlantTick_ns;
  for (; next_ < events_.size() && events_[next_].time_ns < end_ns; ++next_) {
    const ScheduledEvent& event = events_[next_];
    const core::Nanoseconds time_ns = std::max(event.time_ns, start_ns);
    if (!fire(rig, event, time_ns)) {
      break;
    }
    if (event.kind == ScheduledEventKind::kReset) {
      reset_ns = time_ns;
    }
    observer.on_event({.time_ns = time_ns,
                       .kind = PlantEventKind::kScheduledEventFired,
                       .axis = event.axis,
                       .value = static_cast<double>(next_)});
  }
  return reset_ns;
}

}  // namespace towbench::emulator
