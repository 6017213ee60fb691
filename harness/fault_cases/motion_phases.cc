#include "harness/fault_cases/motion_phases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/fault_cases/truth_phases.h"

namespace towbench::harness {
namespace {

using bbmc::AxisMode;
using Kind = bbmc::ControllerEvent::Kind;

std::string_view phase_at(const CaseRecord& run, core::Axis axis, std::size_t i) {
  constexpr double kStands_m_per_s = 1e-6;
  constexpr double kSteady_m_per_s = 1e-7;  // a tick; 0.1 mm/s^2
  constexpr double kReversing_m_per_s = 0.01;
  const auto& now = run.log[i].axes[axis];
  switch (now.mode) {
    case AxisMode::kIdle:
    case AxisMode::kFaulted:
      return "rest";
    case AxisMode::kOpenLoop:
      return now.duty_pct != 0.0 ? "open_loop" : "rest";
    case AxisMode::kBraking:
      return "brake";
    default:
      break;
  }
  const double speed = std::fabs(now.reference_velocity_m_per_s);
  const auto& before = run.log[i == 0 ? 0 : i - 1].axes[axis];
  const double change = speed - std::fabs(before.reference_velocity_m_per_s);
  const auto& ahead = run.log[std::min(i + 20, run.log.size() - 1)].axes[axis];
  const bool turns = now.reference_velocity_m_per_s * ahead.reference_velocity_m_per_s < 0 ||
                     before.reference_velocity_m_per_s * now.reference_velocity_m_per_s < 0;
  if (turns && speed < kReversing_m_per_s) {
    return "reverse";
  }
  if (std::fabs(change) > kSteady_m_per_s) {
    return change > 0 ? "accelerate" : "decelerate";
  }
  return speed < kStands_m_per_s ? "hold" : "cruise";
}

// A motion of both axes may leave one of them where it is.
bool travels(const CaseRecord& run, const bbmc::ControllerEvent& start) {
  constexpr double kTravel_m = 1e-3;
  const auto end = std::find_if(run.controller_events.begin(), run.controller_events.end(),
                                [&](const auto& event) {
                                  return event.kind == Kind::kMotionEnded &&
                                         event.axis == start.axis && event.time_ns >= start.time_ns;
                                });
  const auto end_ns = end == run.controller_events.end() ? run.outcome.end_ns : end->time_ns;
  const double from_m = run.truth_at(start.time_ns).axes[start.axis].carriage_m;
  return std::any_of(run.truth.begin(), run.truth.end(), [&](const auto& row) {
    return row.time_ns >= start.time_ns && row.time_ns <= end_ns &&
           std::fabs(row.axes[start.axis].carriage_m - from_m) > kTravel_m;
  });
}

// "y_max", "x_home" and the like; of no other name than those of kEventNames.
protocol::InputLine line_of_event(std::string_view name) {
  for (const auto axis : core::kPlanarAxes) {
    const std::string_view letter = core::name_of(axis);
    if (name.starts_with(letter)) {
      return name.ends_with("_home") ? protocol::home_line(axis)
                                     : protocol::hall_line(axis, name.ends_with("_max"));
    }
  }
  return protocol::InputLine::kKillSwitch;
}

std::optional<core::Nanoseconds> event_onset(const std::string& name, const CaseRecord& reference) {
  const auto controller = [&](Kind kind, bool of_travel) -> std::optional<core::Nanoseconds> {
    const auto moving = moving_axis(reference);
    for (const auto& event : reference.controller_events) {
      if (event.kind == kind && (!of_travel || event.axis == moving)) {
        return event.time_ns;
      }
    }
    return std::nullopt;
  };
  if (name == "motion" || name == "motion_end") {
    const bool begin = name == "motion";
    if (tells_of_itself(reference)) {
      return controller(begin ? Kind::kMotionStarted : Kind::kMotionEnded, true);
    }
    const auto travel = travel_of(reference, first_to_travel(reference));
    return travel ? std::optional(begin ? travel->from_ns : travel->to_ns) : std::nullopt;
  }
  if (name == "fault") {
    return controller(Kind::kFaultLatched, false);
  }
  const auto line = line_of_event(name);
  for (const auto& event : reference.plant_events) {
    if (event.kind == emulator::PlantEventKind::kInputLineChanged &&
        static_cast<protocol::InputLine>(static_cast<int>(event.value)) == line &&
        (event.lines & protocol::mask_of(line)) != 0) {
      return event.time_ns;
    }
  }
  return std::nullopt;
}

// First moment at which `value`, less `level`, has changed its sign; on the line between two rows.
template <typename Value>
std::optional<core::Nanoseconds> crossing(const CaseRecord& reference, double level, Value value) {
  for (std::size_t i = 1; i < reference.truth.size(); ++i) {
    const double before = value(reference.truth[i - 1]) - level;
    const double after = value(reference.truth[i]) - level;
    if (before != after && ((before < 0) != (after < 0))) {
      const double share = before / (before - after);
      const auto span_ns =
          static_cast<double>(reference.truth[i].time_ns - reference.truth[i - 1].time_ns);
      return reference.truth[i - 1].time_ns + static_cast<core::Nanoseconds>(share * span_ns);
    }
  }
  return std::nullopt;
}

}  // namespace

bool tells_of_itself(const CaseRecord& run) noexcept {
  return run.of_bbmc && !run.log.empty();
}

std::vector<PhaseSpan> phases_of(const CaseRecord& run, core::Axis axis) {
  if (!tells_of_itself(run)) {
    return phases_of_truth(run, axis);
  }
  std::vector<PhaseSpan> spans;
  for (std::size_t i = 0; i < run.log.size(); ++i) {
    const auto phase = phase_at(run, axis, i);
    const auto time_ns = run.log[i].time_ns;
    if (spans.empty() || spans.back().phase != phase) {
      if (!spans.empty()) {
        spans.back().to_ns = time_ns;
      }
      spans.push_back({phase, time_ns, time_ns});
    }
    spans.back().to_ns = time_ns;
  }
  return spans;
}

core::Axis moving_axis(const CaseRecord& run) {
  if (!tells_of_itself(run)) {
    return first_to_travel(run);
  }
  for (const auto& event : run.controller_events) {
    if (event.kind == Kind::kMotionStarted && travels(run, event)) {
      return event.axis;
    }
  }
  return core::kFirstAxis;
}

core::Axis trigger_axis(const Fault& fault, const CaseRecord& reference) {
  switch (fault.place.part) {
    case FaultPart::kEndStop:
    case FaultPart::kEncoder:
    case FaultPart::kAmplifier:
    case FaultPart::kDriveTrain:
    case FaultPart::kHomeSwitch:
      return fault.place.axis;
    default:
      return moving_axis(reference);
  }
}

std::optional<core::Nanoseconds> onset_of(const FaultTrigger& trigger, core::Axis axis,
                                          const CaseRecord& reference) {
  std::optional<core::Nanoseconds> met;
  switch (trigger.kind) {
    case FaultTrigger::Kind::kTime:
      met = core::nanoseconds(trigger.value);
      break;
    case FaultTrigger::Kind::kPosition:
      met = crossing(reference, trigger.value,
                     [&](const auto& row) { return row.axes[axis].carriage_m; });
      break;
    case FaultTrigger::Kind::kSpeed:
      met = crossing(reference, trigger.value, [&](const auto& row) {
        return std::fabs(row.axes[axis].carriage_speed_m_per_s);
      });
      break;
    case FaultTrigger::Kind::kEvent:
      met = event_onset(trigger.name, reference);
      break;
    case FaultTrigger::Kind::kPhase:
      for (const auto& span : phases_of(reference, axis)) {
        if (span.phase == trigger.name) {
          met = span.from_ns;
          break;
        }
      }
      break;
  }
  return met ? std::optional(*met + core::nanoseconds(trigger.after_s)) : std::nullopt;
}

double moment_in(const std::vector<PhaseSpan>& spans, core::Random& random) {
  const auto& span = spans[random.bits() % spans.size()];
  const auto length_ns = static_cast<double>(span.to_ns - span.from_ns);
  return core::seconds(span.from_ns + static_cast<core::Nanoseconds>(random.uniform() * length_ns));
}

}  // namespace towbench::harness
