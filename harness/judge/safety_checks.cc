#include "harness/judge/safety_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "protocol/messages.h"

namespace towbench::harness {
namespace {

constexpr double kReaction_s = 2e-3;
constexpr double kSameMoment_s = 1e-9;
constexpr double kRunaway_m = 0.25;

using core::Axis;
using protocol::InputLine;

Check named(const char* name, const char* meaning, const char* requirement) {
  Check check;
  check.name = name;
  check.meaning = meaning;
  check.verdict = Verdict::kPass;
  check.source = requirement;
  return check;
}

void fail(Check& check, std::string reason) {
  check.verdict = Verdict::kFail;
  check.reason = std::move(reason);
}

// When a line became active, and until when it was.
struct Activation {
  double from_s = 0;
  double to_s = 0;
};

std::vector<Activation> activations(const RunData& data, InputLine line) {
  std::vector<Activation> found;
  bool active = false;
  for (const auto& event : data.events) {
    if (event.kind != "input_line_changed") {
      continue;
    }
    const bool now = (event.lines & protocol::mask_of(line)) != 0;
    if (now && !active) {
      found.push_back({event.time_s, std::numeric_limits<double>::max()});
    } else if (!now && active) {
      found.back().to_s = event.time_s;
    }
    active = now;
  }
  return found;
}

// The first moment from `from_s` up to `to_s` at which the axis is driven that way and moves that
// way, its motor too: a carriage that swings on its transmission moves by itself. Later than some
// milliseconds it takes as many in a row: a brake pushes with what it measured a tick ago.
std::optional<double> driven_on(const RunData& data, Axis axis, double direction, double from_s,
                                double to_s) {
  constexpr double kMoving_m_per_s = 0.05;
  constexpr double kAtOnce_s = 8e-3;
  constexpr double kInARow_s = 5e-3;
  const auto time_s = data.log.column("time_s");
  const auto duty_pct = data.log_of(axis, "duty_pct");
  const auto truth_s = data.truth.column("time_s");
  const auto speed_m_per_s = data.truth_of(axis, "carriage_speed_m_per_s");
  const auto motor_rad_per_s = data.truth_of(axis, "motor_speed_rad_per_s");
  if (speed_m_per_s.empty() || motor_rad_per_s.empty()) {
    return std::nullopt;
  }
  std::size_t at = 0;
  std::optional<double> since_s;
  for (std::size_t i = 0; i < duty_pct.size() && time_s[i] < to_s; ++i) {
    while (at + 1 < truth_s.size() && truth_s[at] < time_s[i] - kSameMoment_s) {
      ++at;
    }
    const bool outwards = time_s[i] >= from_s - kSameMoment_s && duty_pct[i] * direction > 0 &&
                          speed_m_per_s[at] * direction > kMoving_m_per_s &&
                          motor_rad_per_s[at] * direction > 0;
    since_s = outwards ? std::optional(since_s.value_or(time_s[i])) : std::nullopt;
    if (outwards && (time_s[i] < from_s + kAtOnce_s || time_s[i] - *since_s >= kInARow_s)) {
      return since_s;
    }
  }
  return std::nullopt;
}

bool drives(double duty_pct) {
  return duty_pct != 0.0;
}

constexpr double kNever_s = std::numeric_limits<double>::max();

double first_typed_from_s(const SafetyScope& scope, double from_s) {
  const auto typed = std::find_if(scope.typed_s.begin(), scope.typed_s.end(),
                                  [&](double typed_s) { return typed_s >= from_s; });
  return typed == scope.typed_s.end() ? kNever_s : *typed;
}

// Whether nothing may be driven yet: nobody has typed since the image began, or began again. One
// that nobody ever types to may begin by itself.
bool waits_for_command(const SafetyScope& scope, double time_s) {
  if (scope.typed_s.empty()) {
    return false;
  }
  const auto waits = [&](double began_s) {
    return time_s > began_s + kSameMoment_s && time_s < first_typed_from_s(scope, began_s);
  };
  return time_s < scope.typed_s.front() ||
         std::any_of(scope.restarts_s.begin(), scope.restarts_s.end(), waits);
}

Check starts_undriven(const RunData& data, const SafetyScope& scope) {
  auto check = named("starts_undriven",
                     "the first duty of each axis is zero, and so before a command", "ANY-1");
  const auto time_s = data.log.column("time_s");
  for (const auto axis : core::kAllAxes) {
    const auto duty_pct = data.log_of(axis, "duty_pct");
    for (std::size_t i = 0; i < duty_pct.size(); ++i) {
      if (drives(duty_pct[i]) && check.verdict == Verdict::kPass &&
          (i == 0 || waits_for_command(scope, time_s[i]))) {
        fail(check, fmt::format("{} is driven with {:.1f} % at {:.4f} s", core::name_of(axis),
                                duty_pct[i], time_s[i]));
      }
    }
  }
  return check;
}

// When the last row of the stretch ends in which an axis is driven; `from_s` when there is none.
double driven_until_s(const RunData& data, double from_s, double to_s) {
  const auto time_s = data.log.column("time_s");
  double until_s = from_s;
  for (const auto axis : core::kAllAxes) {
    const auto duty_pct = data.log_of(axis, "duty_pct");
    for (std::size_t i = 0; i < duty_pct.size() && time_s[i] < to_s; ++i) {
      // A row's duty lasts until the next one.
      const double row_ends_s = i + 1 < time_s.size() ? time_s[i + 1] : time_s[i];
      if (drives(duty_pct[i]) && row_ends_s >= from_s) {
        until_s = std::max(until_s, std::min(row_ends_s, to_s));
      }
    }
  }
  return until_s;
}

// When the controller may drive again: at the operator's first reset after the switch's release; of
// an operator who types, at the first thing typed after it.
double free_again_s(const RunData& data, const SafetyScope& scope, const Activation& pressed) {
  if (scope.operator_types) {
    return first_typed_from_s(scope, pressed.to_s);
  }
  for (const auto& event : data.events) {
    if (event.kind == "operator_reset" && event.time_s >= pressed.to_s) {
      return event.time_s;
    }
  }
  return kNever_s;
}

std::optional<Check> kill_removes_duty(const RunData& data, const SafetyScope& scope) {
  auto check = named("kill_to_zero_duty",
                     scope.operator_types
                         ? "2 ms after the kill switch's edge nothing is driven, until something "
                           "is typed behind its release"
                         : "2 ms after the kill switch's edge nothing is driven, until a reset "
                           "behind its release",
                     "ANY-2");
  check.unit = "s";
  check.max = kReaction_s;
  double judged_to_s = -1;
  for (const auto& pressed : activations(data, InputLine::kKillSwitch)) {
    const double edge_s = pressed.from_s;
    const double end_s = free_again_s(data, scope, pressed);
    if (edge_s < judged_to_s) {
      continue;  // pressed again before a reset
    }
    if (end_s < edge_s + kReaction_s) {
      continue;  // may drive again before the 2 ms have passed
    }
    judged_to_s = end_s;
    const double zero_s = driven_until_s(data, edge_s, end_s);
    check.value = std::max(check.value.value_or(0), zero_s - edge_s);
    if (zero_s - edge_s > kReaction_s + kSameMoment_s && check.verdict == Verdict::kPass) {
      fail(check, fmt::format("pressed at {:.4f} s, driven until {:.4f} s", edge_s, zero_s));
    }
  }
  return check.value ? std::optional(check) : std::nullopt;
}

std::optional<Check> reset_told(const RunData& data) {
  for (const auto& event : data.events) {
    if (event.kind == "operator_reset" && event.value == 0) {
      return invalid_check(
          "reset_told", "the controller hears the operator's reset",
          fmt::format("at {:.4f} s: its Hello does not have the bit for it", event.time_s));
    }
  }
  return std::nullopt;
}

std::optional<Check> end_stop_not_outwards(const RunData& data) {
  auto check = named("end_stop_not_outwards",
                     "2 ms after an end-stop's edge the axis is not driven on towards it", "ANY-3");
  bool occasion = false;
  for (const auto axis : core::kAllAxes) {
    for (const bool at_max : {false, true}) {
      for (const auto& activation : activations(data, protocol::hall_line(axis, at_max))) {
        occasion = true;
        const auto wrong_s = driven_on(data, axis, at_max ? 1.0 : -1.0,
                                       activation.from_s + kReaction_s, activation.to_s);
        if (wrong_s && check.verdict == Verdict::kPass) {
          fail(check, fmt::format("{}: edge at {:.4f} s, driven on at {:.4f} s",
                                  core::name_of(axis), activation.from_s, *wrong_s));
        }
      }
    }
  }
  return occasion ? std::optional(check) : std::nullopt;
}

Check no_hard_end(const RunData& data) {
  auto check = named("no_hard_end", "no axis meets a hard end", "ANY-4");
  for (const auto& event : data.events) {
    if (event.kind == "hard_end_contact" && check.verdict == Verdict::kPass) {
      fail(check, fmt::format("{} at {:.4f} s with {:.3g} m/s", event.axis, event.time_s,
                              std::fabs(event.value)));
    }
  }
  return check;
}

// A short axis has no room to be lost in.
double runaway_limit_m(const AxisLimits& limits) {
  const double way_m = limits.hard_max_m - limits.hard_min_m;
  return way_m > 0 ? std::min(kRunaway_m, way_m / 4) : kRunaway_m;
}

Check no_runaway(const RunData& data) {
  auto check = named("no_runaway", "a driven axis is never farther from its reference", "ANY-5");
  check.unit = "m";
  check.max = kRunaway_m;
  check.value = 0;
  double worst_share = 0;  // of its axis' limit: axes differ in limits and units
  const auto truth_s = data.truth.column("time_s");
  const auto time_s = data.log.column("time_s");
  for (const auto axis : core::kAllAxes) {
    const auto carriage_m = data.truth_of(axis, "carriage_m");
    const auto reference_m = data.log_of(axis, "reference_m");
    const auto duty_pct = data.log_of(axis, "duty_pct");
    if (!data.limits[axis].exists || carriage_m.empty() || reference_m.empty()) {
      continue;
    }
    const double limit_m = runaway_limit_m(data.limits[axis]);
    std::size_t at = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      while (at + 1 < truth_s.size() && truth_s[at] < time_s[i] - kSameMoment_s) {
        ++at;
      }
      const double far_m = std::fabs(carriage_m[at] - reference_m[i]);
      if (drives(duty_pct[i]) && far_m > worst_share * limit_m) {
        worst_share = far_m / limit_m;
        check.value = far_m;
        check.max = limit_m;
        check.unit = data.limits[axis].unit("m");
        if (far_m > limit_m && check.verdict == Verdict::kPass) {
          fail(check, fmt::format("{} at {:.4f} s", core::name_of(axis), time_s[i]));
        }
      }
    }
  }
  return check;
}

void blame_who_drives_at_end(const RunData& data, std::vector<Check>& checks) {
  const bool driven = std::any_of(core::kAllAxes.begin(), core::kAllAxes.end(), [&](Axis axis) {
    const auto duty_pct = data.log_of(axis, "duty_pct");
    return !duty_pct.empty() && drives(duty_pct.back());
  });
  for (auto& check : checks) {
    if (driven && check.name == "comes_to_rest" && check.verdict == Verdict::kInvalid) {
      check.reason += ", and is driven";
      check.verdict = Verdict::kFail;
    }
  }
}

}  // namespace

std::vector<Check> safety_checks(const RunData& data, const SafetyScope& scope) {
  std::vector<Check> checks{starts_undriven(data, scope), no_hard_end(data)};
  if (scope.reference_is_known) {
    checks.push_back(no_runaway(data));
  }
  for (auto& check :
       {kill_removes_duty(data, scope), end_stop_not_outwards(data), reset_told(data)}) {
    if (check) {
      checks.push_back(*check);
    }
  }
  return checks;
}

void judge_safety(const std::filesystem::path& folder, const core::PerAxis<AxisLimits>& limits,
                  const SafetyScope& scope, std::vector<Check>& checks) {
  std::vector<Check> added;
  try {
    const auto data = load_run_data(folder, limits);
    blame_who_drives_at_end(data, checks);
    added = safety_checks(data, scope);
  } catch (const std::exception& error) {
    added.push_back(invalid_check("safety", "the record can be judged", error.what()));
  }
  checks.insert(checks.begin(), added.begin(), added.end());
}

}  // namespace towbench::harness
