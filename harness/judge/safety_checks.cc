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

// The first row from `from_s` up to `to_s` in which the axis is driven that way and moves that way.
std::optional<double> driven_on(const RunData& data, Axis axis, double direction, double from_s,
                                double to_s) {
  constexpr double kMoving_m_per_s = 0.05;
  const auto time_s = data.log.column("time_s");
  const auto duty_pct = data.log_of(axis, "duty_pct");
  const auto truth_s = data.truth.column("time_s");
  const auto speed_m_per_s = data.truth_of(axis, "carriage_speed_m_per_s");
  std::size_t at = 0;
  for (std::size_t i = 0; i < duty_pct.size() && !speed_m_per_s.empty(); ++i) {
    while (at + 1 < truth_s.size() && truth_s[at] < time_s[i] - kSameMoment_s) {
      ++at;
    }
    if (time_s[i] >= from_s - kSameMoment_s && time_s[i] < to_s && duty_pct[i] * direction > 0 &&
        speed_m_per_s[at] * direction > kMoving_m_per_s) {
      return time_s[i];
    }
  }
  return std::nullopt;
}

bool drives(double duty_pct) {
  return duty_pct != 0.0;
}

Check starts_undriven(const RunData& data) {
  auto check = named("starts_undriven", "the first duty of each axis is zero", "ANY-1");
  for (const auto axis : core::kAxes) {
    const auto duty_pct = data.log_of(axis, "duty_pct");
    if (!duty_pct.empty() && drives(duty_pct.front())) {
      fail(check, fmt::format("{} starts with {:.1f} %", core::name_of(axis), duty_pct.front()));
    }
  }
  return check;
}

std::optional<Check> kill_removes_duty(const RunData& data) {
  const auto pressed = activations(data, InputLine::kKillSwitch);
  if (pressed.empty()) {
    return std::nullopt;
  }
  auto check =
      named("kill_to_zero_duty",
            "2 ms after the kill switch's edge nothing is driven, to the end of the run", "ANY-2");
  check.unit = "s";
  check.max = kReaction_s;
  const double edge_s = pressed.front().from_s;
  double zero_s = edge_s;
  for (const auto axis : core::kAxes) {
    const auto duty_pct = data.log_of(axis, "duty_pct");
    const auto time_s = data.log.column("time_s");
    for (std::size_t i = 0; i < duty_pct.size(); ++i) {
      // Driven from this row until the next one.
      if (time_s[i] >= edge_s && drives(duty_pct[i])) {
        zero_s = std::max(zero_s, i + 1 < time_s.size() ? time_s[i + 1] : time_s[i]);
      }
      if (time_s[i] < edge_s && i + 1 < time_s.size() && time_s[i + 1] >= edge_s &&
          drives(duty_pct[i])) {
        zero_s = std::max(zero_s, time_s[i + 1]);
      }
    }
  }
  check.value = zero_s - edge_s;
  if (*check.value > kReaction_s + kSameMoment_s) {
    fail(check, fmt::format("pressed at {:.4f} s, driven until {:.4f} s", edge_s, zero_s));
  }
  return check;
}

std::optional<Check> end_stop_not_outwards(const RunData& data) {
  struct Sensor {
    InputLine line;
    Axis axis;
    double outwards;
  };
  constexpr std::array kSensors{
      Sensor{InputLine::kHallYMin, Axis::kY, -1}, Sensor{InputLine::kHallYMax, Axis::kY, 1},
      Sensor{InputLine::kHallXMin, Axis::kX, -1}, Sensor{InputLine::kHallXMax, Axis::kX, 1}};
  auto check = named("end_stop_not_outwards",
                     "2 ms after an end-stop's edge the axis is not driven on towards it", "ANY-3");
  bool occasion = false;
  for (const auto& sensor : kSensors) {
    for (const auto& activation : activations(data, sensor.line)) {
      occasion = true;
      const auto wrong_s = driven_on(data, sensor.axis, sensor.outwards,
                                     activation.from_s + kReaction_s, activation.to_s);
      if (wrong_s && check.verdict == Verdict::kPass) {
        fail(check, fmt::format("{}: edge at {:.4f} s, driven on at {:.4f} s",
                                core::name_of(sensor.axis), activation.from_s, *wrong_s));
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

Check no_runaway(const RunData& data) {
  auto check = named("no_runaway", "a driven axis is never farther from its reference", "ANY-5");
  check.unit = "m";
  check.max = kRunaway_m;
  check.value = 0;
  const auto truth_s = data.truth.column("time_s");
  const auto time_s = data.log.column("time_s");
  for (const auto axis : core::kAxes) {
    const auto carriage_m = data.truth_of(axis, "carriage_m");
    const auto reference_m = data.log_of(axis, "reference_m");
    const auto duty_pct = data.log_of(axis, "duty_pct");
    if (!data.limits[axis].exists || carriage_m.empty() || reference_m.empty()) {
      continue;
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      while (at + 1 < truth_s.size() && truth_s[at] < time_s[i] - kSameMoment_s) {
        ++at;
      }
      const double far_m = std::fabs(carriage_m[at] - reference_m[i]);
      if (drives(duty_pct[i]) && far_m > *check.value) {
        check.value = far_m;
        if (far_m > kRunaway_m && check.verdict == Verdict::kPass) {
          fail(check, fmt::format("{} at {:.4f} s", core::name_of(axis), time_s[i]));
        }
      }
    }
  }
  return check;
}

}  // namespace

std::vector<Check> safety_checks(const RunData& data) {
  std::vector<Check> checks{starts_undriven(data), no_hard_end(data), no_runaway(data)};
  for (auto& check : {kill_removes_duty(data), end_stop_not_outwards(data)}) {
    if (check) {
      checks.push_back(*check);
    }
  }
  return checks;
}

std::vector<Check> safety_checks(const std::filesystem::path& folder,
                                 const core::PerAxis<AxisLimits>& limits) {
  try {
    return safety_checks(load_run_data(folder, limits));
  } catch (const std::exception& error) {
    auto check = named("safety", "the record can be judged", "");
    check.verdict = Verdict::kInvalid;
    check.reason = error.what();
    return {check};
  }
}

}  // namespace towbench::harness
