#include "harness/fault_cases/inject.h"

#include <algorithm>
#include <limits>

#include "harness/fault_cases/fault_schedule.h"

namespace towbench::harness {
namespace {

using emulator::ScheduledEvent;
using emulator::ScheduledEventKind;
using emulator::WireCondition;
using protocol::EncoderLine;
using protocol::InputLine;
using enum FaultKind;

// Whose wires an installer takes for this one's.
core::Axis neighbour_of(core::Axis axis) {
  const auto nth = core::index_of(axis);
  return core::kAllAxes[nth == 0 ? 1 : nth - 1];
}

class Injector : FaultSchedule {
 public:
  Injector(const Fault& fault, core::Nanoseconds at_ns, const CaseRecord& reference,
           core::Nanoseconds end_ns, Injection& into)
      : FaultSchedule(fault, at_ns, end_ns, into), reference_(reference) {}

  void run() {
    switch (fault_.place.part) {
      case FaultPart::kEndStop:
      case FaultPart::kHomeSwitch:
        return position_switch();
      case FaultPart::kKillSwitch:
        return kill_switch();
      case FaultPart::kEncoder:
        return encoder();
      case FaultPart::kAmplifier:
        return amplifier();
      case FaultPart::kSupply:
        return hold(
            fault_.kind == kSag ? ScheduledEventKind::kSagSupply : ScheduledEventKind::kLoadSupply,
            parameter(0), 0.0);
      case FaultPart::kDriveTrain:
        return drive_train();
      case FaultPart::kLink:
        into_.link.push_back({.kind = fault_.kind,
                              .to_plant = fault_.place.to_plant,
                              .from_ns = at_ns_,
                              .until_ns = until_ns_,
                              .amount = parameter(0),
                              .seed = fault_.seed});
        return;
      case FaultPart::kHost:
        return host();
    }
  }

 private:
  void position_switch() {
    const InputLine line = fault_.place.switch_line();
    switch (fault_.kind) {
      case kStuckOpen:
        return hold_line(line, WireCondition::kStuckLow);
      case kStuckClosed:
        return hold_line(line, WireCondition::kStuckHigh);
      case kBrokenWire:
        return hold_line(line,
                         parameter(0) > 0.5 ? WireCondition::kStuckHigh : WireCondition::kStuckLow);
      case kSwappedEnds:
        return cross(line, protocol::hall_line(fault_.place.axis, !fault_.place.at_max));
      case kSwappedAxes:
        return cross(line,
                     protocol::hall_line(neighbour_of(fault_.place.axis), fault_.place.at_max));
      case kBounce:
        if (const auto edge_ns = next_edge_ns(line); edge_ns >= 0) {
          bounce(edge_ns, [&](core::Nanoseconds time_ns, bool away) {
            rewire(time_ns, line, away ? WireCondition::kInverted : WireCondition::kIntact);
          });
        }
        return;
      default:
        return;  // built in
    }
  }

  // Of the machine, in the reference run; -1 when none comes.
  [[nodiscard]] core::Nanoseconds next_edge_ns(InputLine line) const {
    for (const auto& event : reference_.plant_events) {
      if (event.kind == emulator::PlantEventKind::kInputLineChanged && event.time_ns >= at_ns_ &&
          static_cast<InputLine>(static_cast<int>(event.value)) == line) {
        return event.time_ns;
      }
    }
    return -1;
  }

  void press(core::Nanoseconds time_ns, bool pressed) {
    add({.time_ns = time_ns,
         .kind = pressed ? ScheduledEventKind::kPressKillSwitch
                         : ScheduledEventKind::kReleaseKillSwitch});
  }

  void kill_switch() {
    switch (fault_.kind) {
      case kBrokenWire:
        return hold_line(InputLine::kKillSwitch, WireCondition::kStuckHigh);
      case kWelded:
        hold_line(InputLine::kKillSwitch, WireCondition::kStuckLow);
        return press(at_ns_ + kOperatorReaction_ns, true);
      case kReleased:
        press(at_ns_, true);
        return press(at_ns_ + core::nanoseconds(parameter(0)), false);
      case kBounce:
        press(at_ns_, true);
        bounce(at_ns_, [&](core::Nanoseconds time_ns, bool away) { press(time_ns, !away); });
        break;
      default:
        press(at_ns_, true);
        break;
    }
    if (!lasts_) {
      press(until_ns_, false);
    }
  }

  // Random moments of the given rate; `change` is told each one.
  template <typename Change>
  void at_random(double rate_Hz, Change change) {
    double time_s = core::seconds(at_ns_);
    while (true) {
      // Uniform over twice the mean distance: no two pulses further apart than that.
      time_s += 2.0 * random_.uniform() / rate_Hz;
      const auto time_ns = core::nanoseconds(time_s);
      if (time_ns >= until_ns_) {
        return;
      }
      change(time_ns);
    }
  }
  void pulse(core::Nanoseconds time_ns, EncoderLine line, double width_s, WireCondition condition) {
    rewire(time_ns, line, condition);
    rewire(time_ns + core::nanoseconds(width_s), line, WireCondition::kIntact);
  }

  void encoder() {
    const auto level = parameter(0) > 0.5 ? WireCondition::kStuckHigh : WireCondition::kStuckLow;
    switch (fault_.kind) {
      case kDeadA:
        return hold_line(EncoderLine::kA, level);
      case kDeadB:
        return hold_line(EncoderLine::kB, level);
      case kIndexMissing:
        return hold_line(EncoderLine::kIndex, WireCondition::kStuckLow);
      case kInverted:
        return hold_line(EncoderLine::kA, WireCondition::kInverted);
      case kFrozen:
        hold(ScheduledEventKind::kHoldAbsolute, 1.0, 0.0);
        hold_line(EncoderLine::kA, WireCondition::kStuckLow);
        hold_line(EncoderLine::kB, WireCondition::kStuckLow);
        return hold_line(EncoderLine::kIndex, WireCondition::kStuckLow);
      case kSwappedChannels:
        return hold(ScheduledEventKind::kSwapEncoderChannels, 1.0, 0.0);
      case kJump:
        return once(ScheduledEventKind::kTurnDisc);
      case kSlip:
        return once(ScheduledEventKind::kSlipDisc);
      case kExtraEdges:
        return at_random(parameter(0), [&](core::Nanoseconds time_ns) {
          pulse(time_ns, EncoderLine::kA, parameter(1), WireCondition::kInverted);
        });
      case kMissingEdges:
        return at_random(parameter(0), [&](core::Nanoseconds time_ns) {
          pulse(time_ns, EncoderLine::kA, parameter(1), WireCondition::kStuckLow);
        });
      case kNoiseBurst:
        return at_random(parameter(0), [&](core::Nanoseconds time_ns) {
          const auto line = static_cast<EncoderLine>(random_.bits() % 3);
          pulse(time_ns, line, parameter(1), WireCondition::kInverted);
        });
      case kIllegalTransitions: {
        bool inverted = false;
        return at_random(parameter(0), [&](core::Nanoseconds time_ns) {
          inverted = !inverted;
          const auto condition = inverted ? WireCondition::kInverted : WireCondition::kIntact;
          rewire(time_ns, EncoderLine::kA, condition);
          rewire(time_ns, EncoderLine::kB, condition);
        });
      }
      default:
        return;  // built in
    }
  }

  void amplifier() {
    constexpr double kNoLimit = std::numeric_limits<double>::infinity();
    const InputLine ready = protocol::ready_line(fault_.place.axis);
    switch (fault_.kind) {
      case kDisabled:
      case kOverTemperature:
        hold(ScheduledEventKind::kAmplifierOff, 1.0, 0.0);
        return hold_line(ready, WireCondition::kStuckLow);
      case kStuckDuty:
        return hold(ScheduledEventKind::kHoldCommand, 1.0, 0.0);
      case kSaturatedEarly:
        return hold(ScheduledEventKind::kLimitCommand, parameter(0), kNoLimit);
      case kGainDrop:
        return hold(ScheduledEventKind::kScaleCommand, parameter(0), 1.0);
      case kInverted:
        return hold(ScheduledEventKind::kScaleCommand, -1.0, 1.0);
      case kBothChannels:
        return hold(ScheduledEventKind::kShortBridge, 1.0, 0.0);
      default:
        return;
    }
  }

  void drive_train() {
    switch (fault_.kind) {
      case kJam:
        return hold(ScheduledEventKind::kJamCarriage, 1.0, 0.0);
      case kBrakeDrag:
        return hold(ScheduledEventKind::kDragCarriage, parameter(0), 0.0);
      case kObstacle:
        return hold(ScheduledEventKind::kObstacle, parameter(0), 0.0);
      case kToothSkip:
        return once(ScheduledEventKind::kSkipTooth);
      case kBrakeStuck:
        return hold(ScheduledEventKind::kStickBrake, 1.0, 0.0);
      case kBrakeLost:
        return hold(ScheduledEventKind::kLoseBrake, 1.0, 0.0);
      case kDroppedLoad:
        return hold(ScheduledEventKind::kDropLoad, parameter(0), 0.0);
      default:
        return;
    }
  }

  void host() {
    auto& host = into_.host;
    if (fault_.kind == kClockStep) {
      host.steps.push_back({at_ns_, until_ns_, core::nanoseconds(parameter(0))});
      return;
    }
    if (fault_.kind == kFullDisk) {
      host.full_disks.push_back({at_ns_, until_ns_});
      return;
    }
    if (fault_.kind == kKilledWhileLogging) {
      host.killed_ns = at_ns_;
      return;
    }
    const double length_s = fault_.kind == kMissedTicks
                                ? parameter(0) * core::seconds(reference_.outcome.control_period_ns)
                                : parameter(0);
    host.stalls.push_back({at_ns_, at_ns_ + core::nanoseconds(length_s)});
  }

  const CaseRecord& reference_;
};

}  // namespace

void inject(const Fault& fault, core::Nanoseconds at_ns, const CaseRecord& reference,
            core::Nanoseconds end_ns, Injection& injection) {
  Injector(fault, at_ns, reference, end_ns, injection).run();
}

void finish(Injection& injection, const emulator::RigParameters& rig) {
  std::erase_if(injection.events, [&](const ScheduledEvent& event) {
    return event.kind == ScheduledEventKind::kHoldAbsolute &&
           !rig.axes[event.axis].encoder.absolute;
  });
  std::stable_sort(injection.events.begin(), injection.events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
}

}  // namespace towbench::harness
