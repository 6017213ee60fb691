// When a fault changes what: events of the plant from its onset to its end, and back again there.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "emulator/faults/scheduled_event.h"
#include "harness/fault_plan/fault.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

class FaultSchedule {
 protected:
  using ScheduledEvent = emulator::ScheduledEvent;
  using ScheduledEventKind = emulator::ScheduledEventKind;
  using WireCondition = emulator::WireCondition;
  using EncoderLine = protocol::EncoderLine;
  using InputLine = protocol::InputLine;

  // Without a duration the fault lasts to `end_ns`, the end of the run.
  FaultSchedule(const Fault& fault, core::Nanoseconds at_ns, core::Nanoseconds end_ns,
                Injection& into)
      : fault_(fault),
        at_ns_(at_ns),
        until_ns_(fault.duration_s ? at_ns + core::nanoseconds(*fault.duration_s) : end_ns),
        lasts_(!fault.duration_s),
        random_(fault.seed),
        into_(into) {}

  [[nodiscard]] double parameter(std::size_t i) const { return fault_.parameters[i]; }

  void add(ScheduledEvent event) {
    event.axis = fault_.place.axis;
    into_.events.push_back(event);
  }
  // `on` from the start, `off` at the end of the fault's duration.
  void hold(ScheduledEventKind kind, double on, double off) {
    add({.time_ns = at_ns_, .kind = kind, .value = on});
    if (!lasts_) {
      add({.time_ns = until_ns_, .kind = kind, .value = off});
    }
  }
  void once(ScheduledEventKind kind) {
    add({.time_ns = at_ns_, .kind = kind, .value = parameter(0)});
  }
  void rewire(core::Nanoseconds time_ns, InputLine line, WireCondition condition) {
    add({.time_ns = time_ns,
         .kind = ScheduledEventKind::kRewireInput,
         .input_line = line,
         .condition = condition});
  }
  void cross(InputLine a, InputLine b) {
    for (const auto time_ns : {at_ns_, until_ns_}) {
      if (time_ns == at_ns_ || !lasts_) {
        add({.time_ns = time_ns,
             .kind = ScheduledEventKind::kCrossInputs,
             .input_line = a,
             .other_line = b});
      }
    }
  }
  void rewire(core::Nanoseconds time_ns, EncoderLine line, WireCondition condition) {
    add({.time_ns = time_ns,
         .kind = ScheduledEventKind::kRewireEncoder,
         .encoder_line = line,
         .condition = condition});
  }
  // Of the machine's lines, or of an encoder's.
  template <typename Line>
  void hold_line(Line line, WireCondition condition) {
    rewire(at_ns_, line, condition);
    if (!lasts_) {
      rewire(until_ns_, line, WireCondition::kIntact);
    }
  }

  // 2 x `bounces` changes after `from_ns`, at random times, that end where they began.
  template <typename Change>
  void bounce(core::Nanoseconds from_ns, Change change) {
    const auto changes = static_cast<std::size_t>(2 * std::lround(parameter(0)));
    std::vector<core::Nanoseconds> times;
    for (std::size_t i = 0; i < changes; ++i) {
      times.push_back(from_ns + 1 + core::nanoseconds(random_.uniform() * parameter(1)));
    }
    std::sort(times.begin(), times.end());
    for (std::size_t i = 0; i < changes; ++i) {
      change(times[i], i % 2 == 0);
    }
  }

  const Fault& fault_;
  core::Nanoseconds at_ns_;
  core::Nanoseconds until_ns_;
  bool lasts_;
  core::Random random_;
  Injection& into_;
};

}  // namespace towbench::harness
