// What must follow when the controller has been told: kill switch, end-stop, a latched fault.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using bbmc::AxisMode;
using core::Axis;
using core::Nanoseconds;
using protocol::InputLine;

constexpr Nanoseconds kReaction_ns = 2 * core::kNanosecondsPerMillisecond;

struct Edge {
  InputLine line = InputLine::kKillSwitch;
  Nanoseconds change_ns = 0;  // the edge itself, or when it arrived on a link that held it back
  Nanoseconds seen_ns = 0;    // the controller could look at it
};

// Every line that became active, as the controller heard it.
std::vector<Edge> activations(const CaseEvidence& evidence) {
  std::vector<Edge> edges;
  protocol::InputLines before = 0;
  const auto& run = evidence.run;
  for (std::size_t i = 0; i < run.lines.size(); ++i) {
    const auto& arrival = run.lines[i];
    const protocol::InputLines risen = arrival.lines & ~before;
    before = arrival.lines;
    const bool late = arrival.served_ns - arrival.change_ns > run.outcome.exchange_ns;
    const auto seen_ns = served_ns(evidence, arrival.served_ns);
    for (unsigned line = 0; line < protocol::kInputLineCount; ++line) {
      if (((risen >> line) & 1U) != 0) {
        const auto change_ns = late ? arrival.served_ns : arrival.change_ns;
        edges.push_back({static_cast<InputLine>(line),
                         seen_ns > arrival.served_ns ? seen_ns : change_ns, seen_ns});
      }
    }
  }
  return edges;
}

// First driving message after `from_ns` and before a reset; -1 when there is none.
Nanoseconds drive_after(const CaseRecord& run, Nanoseconds from_ns) {
  const auto reset_ns = run.next_reset_ns(from_ns);
  for (const auto& duty : run.duties) {
    if (duty.time_ns > from_ns && duty.time_ns < reset_ns && duty.drives()) {
      return duty.time_ns;
    }
  }
  return -1;
}

// A motion was under way whose end names the fault.
bool moves_at(const CaseRecord& run, const bbmc::ControllerEvent& fault) {
  bool moves = false;
  for (const auto& event : run.controller_events) {
    if (event.time_ns > fault.time_ns) {
      break;
    }
    const bool ended_before =
        event.kind == Kind::kMotionEnded &&
        (event.time_ns < fault.time_ns || event.code == core::ErrorCode::kNone);
    moves = event.kind == Kind::kMotionStarted || (moves && !ended_before);
  }
  return moves;
}

// A line was typed that the run was long enough to answer.
bool asks_since(const CaseRecord& run, Nanoseconds from_ns) {
  constexpr Nanoseconds kAnswer_ns = 20 * core::kNanosecondsPerMillisecond;
  return std::any_of(run.typed_lines.begin(), run.typed_lines.end(), [&](const ConsoleText& line) {
    return line.time_ns >= from_ns && line.time_ns + kAnswer_ns <= run.outcome.end_ns;
  });
}

}  // namespace

MaybeCheck kill_removes_drive(const CaseEvidence& evidence, CaseFigures& figures) {
  constexpr auto kName = "kill_to_zero_duty";
  constexpr auto kMeaning =
      "kill switch: zero duty within 2 ms of its edge, and none until a reset";
  const auto& run = evidence.run;
  for (const auto& edge : activations(evidence)) {
    if (edge.line != InputLine::kKillSwitch) {
      continue;
    }
    const auto deadline_ns = edge.change_ns + kReaction_ns;
    if (run.outcome.end_ns < deadline_ns) {
      return std::nullopt;
    }
    const auto later_ns = drive_after(run, deadline_ns);
    if (run.driven_at(deadline_ns) || later_ns >= 0) {
      return failed(
          kName, kMeaning,
          fmt::format("pressed at {:.6f} s, driven at {:.6f} s", core::seconds(edge.change_ns),
                      core::seconds(later_ns >= 0 ? later_ns : deadline_ns)));
    }
    const auto end_ns = drive_ends_ns(run, edge.change_ns, run.next_reset_ns(deadline_ns));
    auto check = passed(kName, kMeaning);
    // Nothing was driven: nothing to measure, and no limit to measure it by.
    if (end_ns) {
      check.unit = "s";
      check.max = core::seconds(kReaction_ns);
      check.value = core::seconds(std::max<Nanoseconds>(0, *end_ns - edge.change_ns));
      figures.kill_to_zero_duty_s = check.value;
    }
    if (!latched_by(run, deadline_ns)) {
      return failed(kName, kMeaning, "the switch was pressed and nothing is latched");
    }
    return check;
  }
  return std::nullopt;
}

MaybeCheck end_stop_reacts(const CaseEvidence& evidence, CaseFigures& figures) {
  constexpr auto kName = "end_stop_reaction";
  constexpr auto kMeaning = "end-stop: latched and not driven outwards within 2 ms of the edge";
  constexpr double kMoving_m_per_s = 0.05;
  const auto& run = evidence.run;
  for (const auto& edge : activations(evidence)) {
    const bool is_hall = static_cast<std::size_t>(edge.line) < 2 * core::kPlanarAxes.size();
    const auto before_ns = edge.seen_ns - run.outcome.exchange_ns;
    if (!is_hall || !any_driven_mode(run, before_ns) || latched_by(run, before_ns)) {
      continue;
    }
    const auto line = static_cast<std::size_t>(edge.line);
    const Axis axis = core::kPlanarAxes[line / 2];
    const double outward = edge.line == protocol::hall_line(axis, true) ? 1.0 : -1.0;
    const auto deadline_ns = edge.change_ns + kReaction_ns;
    if (!latched_by(run, deadline_ns)) {
      return failed(kName, kMeaning,
                    fmt::format("edge at {:.6f} s, nothing latched 2 ms later",
                                core::seconds(edge.change_ns)));
    }
    double duty = 0;
    for (const auto& message : run.duties) {
      if (message.time_ns <= deadline_ns && message.axis == axis) {
        duty = message.enable ? message.duty : 0.0;
      }
    }
    const auto& row = run.truth_at(deadline_ns);
    const bool moves_out = outward * row.axes[axis].carriage_speed_m_per_s > kMoving_m_per_s &&
                           outward * row.axes[axis].motor_speed_rad_per_s > 0;
    if (duty * outward > 0 && moves_out) {
      return failed(kName, kMeaning,
                    fmt::format("edge at {:.6f} s, still driven outwards with {:.1f} % 2 ms later",
                                core::seconds(edge.change_ns), 100 * duty));
    }
    auto check = passed(kName, kMeaning);
    const auto* fault = run.first_fault();
    const auto code =
        outward > 0 ? core::ErrorCode::kFaultEndStopMax : core::ErrorCode::kFaultEndStopMin;
    const bool is_end_stop = fault->code == core::ErrorCode::kFaultEndStopMin ||
                             fault->code == core::ErrorCode::kFaultEndStopMax;
    if (is_end_stop && (fault->code != code || fault->axis != axis)) {
      return failed(kName, kMeaning,
                    fmt::format("latched as fault {} of {}, the switch was that of {} {}",
                                core::number_of(fault->code), core::name_of(fault->axis),
                                core::name_of(axis), outward > 0 ? "max" : "min"));
    }
    if (fault->time_ns >= edge.seen_ns - run.outcome.exchange_ns) {
      check.value = core::seconds(std::max<Nanoseconds>(0, fault->time_ns - edge.change_ns));
      check.unit = "s";
      check.max = core::seconds(kReaction_ns);
      figures.end_stop_to_reaction_s = check.value;
    }
    return check;
  }
  return std::nullopt;
}

MaybeCheck no_drive_while_latched(const CaseEvidence& evidence) {
  constexpr auto kName = "stays_latched";
  constexpr auto kMeaning = "a latched fault stays, and nothing is driven again without a reset";
  const auto& run = evidence.run;
  const auto* fault = run.first_fault();
  if (fault == nullptr) {
    return std::nullopt;
  }
  const auto reset_ns = run.next_reset_ns(fault->time_ns);
  bool at_rest = false;
  for (const auto& row : run.log) {
    if (row.time_ns <= fault->time_ns || row.time_ns >= reset_ns) {
      continue;
    }
    if (row.fault == core::ErrorCode::kNone) {
      return failed(kName, kMeaning,
                    fmt::format("fault gone at {:.4f} s", core::seconds(row.time_ns)));
    }
    for (const Axis axis : core::kPlanarAxes) {
      if (is_driven_mode(row.axes[axis].mode)) {
        return failed(kName, kMeaning,
                      fmt::format("{} is driven at {:.4f} s", core::name_of(axis),
                                  core::seconds(row.time_ns)));
      }
    }
    const bool rests =
        std::none_of(core::kPlanarAxes.begin(), core::kPlanarAxes.end(),
                     [&](Axis axis) { return row.axes[axis].mode == AxisMode::kBraking; });
    if (at_rest && !rests) {
      return failed(kName, kMeaning,
                    fmt::format("brakes anew at {:.4f} s", core::seconds(row.time_ns)));
    }
    at_rest = at_rest || rests;
    if (at_rest && run.driven_at(row.time_ns)) {
      return failed(kName, kMeaning,
                    fmt::format("duty at {:.4f} s after the stop", core::seconds(row.time_ns)));
    }
  }
  return passed(kName, kMeaning);
}

MaybeCheck stop_ends_in_time(const CaseEvidence& evidence) {
  constexpr auto kName = "stop_in_bounded_time";
  constexpr auto kMeaning = "no drive any more within the longest braking time";
  const auto& run = evidence.run;
  double longest_s = 0;
  for (const auto& axis : evidence.fixture.controller.configuration.axes) {
    longest_s = std::max(longest_s, axis.braking.timeout_s);
  }
  longest_s += 2 * core::seconds(run.outcome.exchange_ns);
  const auto* fault = run.first_fault();
  auto limit_ns = fault == nullptr ? 0 : fault->time_ns + core::nanoseconds(longest_s);
  for (const auto& stall : evidence.prepared.injection.host.stalls) {
    if (fault != nullptr && stall.from_ns <= limit_ns && stall.until_ns >= fault->time_ns) {
      limit_ns = std::max(limit_ns, stall.until_ns + core::nanoseconds(longest_s));
    }
  }
  if (fault == nullptr || limit_ns > run.outcome.end_ns) {
    return std::nullopt;
  }
  if (run.next_reset_ns(fault->time_ns) <= limit_ns) {
    return passed(kName, kMeaning);  // at rest earlier: only then is a reset taken
  }
  const auto later_ns = drive_after(run, limit_ns);
  if (run.driven_at(limit_ns) || later_ns >= 0) {
    return failed(kName, kMeaning,
                  fmt::format("fault at {:.4f} s, still driven {:.2f} s later",
                              core::seconds(fault->time_ns), longest_s));
  }
  return passed(kName, kMeaning);
}

MaybeCheck operator_is_told(const CaseEvidence& evidence) {
  constexpr auto kName = "operator_told";
  constexpr auto kMeaning = "the console names the fault";
  const auto& run = evidence.run;
  const auto* fault = run.first_fault();
  if (fault == nullptr) {
    return std::nullopt;
  }
  // A reset that works says so, and has nothing to name any more.
  constexpr Nanoseconds kTyping_ns = 20 * core::kNanosecondsPerMillisecond;
  const auto until_ns = run.next_reset_ns(fault->time_ns) - kTyping_ns;
  // A motion that ends well in the very tick before the fault is latched says so after it.
  const bool ended_well =
      std::any_of(run.controller_events.begin(), run.controller_events.end(), [&](const auto& e) {
        return e.kind == bbmc::SystemEvent::Kind::kMotionEnded && e.time_ns == fault->time_ns &&
               e.code == core::ErrorCode::kNone;
      });
  std::string after;
  for (const auto& part : run.printed) {
    const bool since = ended_well ? part.time_ns > fault->time_ns : part.time_ns >= fault->time_ns;
    if (since && part.time_ns < until_ns) {
      after += part.text;
    }
  }
  const auto number = core::number_of(fault->code);
  const bool named = after.find(fmt::format("fault {} ", number)) != std::string::npos ||
                     after.find(fmt::format("fault: {} ", number)) != std::string::npos;
  // Whoever asks for a motion while the switch is held is told to release it.
  const bool told_to_release = fault->code == core::ErrorCode::kFaultKillSwitch &&
                               after.find("error 208") != std::string::npos;
  if (named || told_to_release) {
    return passed(kName, kMeaning);
  }
  if (after.empty() || (!moves_at(run, *fault) && !asks_since(run, fault->time_ns))) {
    return std::nullopt;  // nobody asked, or the run ended before the motion did
  }
  return failed(kName, kMeaning,
                fmt::format("nothing names fault {} after it was latched", number));
}

}  // namespace towbench::harness
