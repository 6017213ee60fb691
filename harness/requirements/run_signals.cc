#include "harness/requirements/run_signals.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "core/axis.h"
#include "harness/checks/recorded_axes.h"
#include "protocol/messages.h"

namespace towbench::harness {
namespace {

using protocol::InputLine;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kStatePosition = 2;  // bbmc::AxisMode::kPosition as log.csv has it

constexpr std::array<RunSignal, 13> kSignals{
    {{"error", "m", "", false, "reference less measured position, while a reference is followed"},
     {"reference", "m", "reference_m", false, "position that the controller follows"},
     {"position", "m", "position_m", false, "measured position"},
     {"speed", "m/s", "velocity_m_per_s", false, "measured speed"},
     {"duty", "%", "duty_pct", false, "as written to the PWM"},
     {"state", "1", "state", false, "mode of the axis; 5 is latched in a fault"},
     {"carriage", "m", "carriage_m", true, "true position of the carriage"},
     {"carriage_speed", "m/s", "carriage_speed_m_per_s", true, "true speed of the carriage"},
     {"end_distance", "m", "", true, "from the carriage to the nearer hard end"},
     {"motor_speed", "rad/s", "motor_speed_rad_per_s", true, "true speed of the motor"},
     {"current", "A", "current_A", true, "of the motor"},
     {"command", "V", "command_V", true, "that the plant heard"},
     {"transmission_force", "N", "transmission_force_N", true, "in the elastic transmission"}}};

std::string end_stop_event(core::Axis axis, bool at_max) {
  return fmt::format("{}_{}_edge", core::name_of(axis), at_max ? "max" : "min");
}

std::string home_event(core::Axis axis) {
  return fmt::format("{}_home_edge", core::name_of(axis));
}

std::vector<RunEventName> make_events() {
  std::vector<RunEventName> events{{"kill_edge", "the kill switch is pressed"},
                                   {"kill_release", "the kill switch is released"}};
  for (const auto axis : core::kAllAxes) {
    for (const bool at_max : {false, true}) {
      events.push_back({end_stop_event(axis, at_max),
                        fmt::format("the end-stop at {}'s {} operates", core::name_of(axis),
                                    at_max ? "maximum" : "minimum"),
                        axis});
    }
  }
  for (const auto axis : core::kAllAxes) {
    events.push_back({home_event(axis),
                      fmt::format("the home switch of {} operates", core::name_of(axis)), axis});
  }
  events.push_back({"fault_latched", "the controller latches a fault"});
  events.push_back(
      {"reset", "the operator's reset is carried out, or told to a controller without a console"});
  events.push_back({"motion_started", "the controller begins a motion"});
  events.push_back({"motion_ended", "a motion ends"});
  events.push_back({"hard_end_contact", "a carriage meets a hard end"});
  return events;
}

std::vector<double> tracking_error(const RunData& data, core::Axis axis) {
  const auto state = data.log_of(axis, "state");
  const auto reference_m = data.log_of(axis, "reference_m");
  const auto position_m = data.log_of(axis, "position_m");
  if (state.empty() || reference_m.empty() || position_m.empty()) {
    return {};
  }
  std::vector<double> error_m(state.size(), kNone);
  for (std::size_t i = 0; i < error_m.size(); ++i) {
    error_m[i] = state[i] == kStatePosition ? reference_m[i] - position_m[i] : kNone;
  }
  return error_m;
}

// Which row of truth.csv each row of log.csv sees.
std::vector<std::size_t> rows_of_truth(const RunData& data) {
  constexpr double kSameRow_s = 1e-9;
  const auto log_s = data.log.column("time_s");
  const auto truth_s = data.truth.column("time_s");
  std::vector<std::size_t> rows(log_s.size());
  std::size_t row = 0;
  for (std::size_t i = 0; i < log_s.size(); ++i) {
    while (row + 1 < truth_s.size() && truth_s[row + 1] <= log_s[i] + kSameRow_s) {
      ++row;
    }
    rows[i] = row;
  }
  return rows;
}

std::vector<double> end_distance(std::vector<double> carriage_m, const AxisLimits& limits) {
  for (auto& value : carriage_m) {
    value = std::min(value - limits.hard_min_m, limits.hard_max_m - value);
  }
  return carriage_m;
}

class SignalReader {
 public:
  explicit SignalReader(const RunData& data) : data_(data), rows_(rows_of_truth(data)) {}

  std::vector<double> read(const RunSignal& signal, core::Axis axis) const {
    if (!data_.limits[axis].exists) {
      return {};
    }
    if (signal.name == "error") {
      return tracking_error(data_, axis);
    }
    if (signal.name == "end_distance") {
      return end_distance(truth(axis, "carriage_m"), data_.limits[axis]);
    }
    if (signal.of_truth) {
      return truth(axis, signal.column);
    }
    const auto column = data_.log_of(axis, signal.column);
    return {column.begin(), column.end()};
  }

 private:
  [[nodiscard]] std::vector<double> truth(core::Axis axis, std::string_view name) const {
    const auto column = data_.truth_of(axis, name);
    std::vector<double> values;
    if (!column.empty()) {
      values.reserve(rows_.size());
      std::transform(rows_.begin(), rows_.end(), std::back_inserter(values),
                     [&](std::size_t row) { return column[row]; });
    }
    return values;
  }

  const RunData& data_;
  std::vector<std::size_t> rows_;
};

// Empty name: no event.
void add_events_of(InputLine line, const std::string& becomes_active,
                   const std::string& becomes_inactive, const RunData& data, Trace& trace) {
  bool active = false;
  for (const auto& event : data.events) {
    if (event.kind != "input_line_changed") {
      continue;
    }
    const bool now = (event.lines & protocol::mask_of(line)) != 0;
    const auto& name = now ? becomes_active : becomes_inactive;
    if (now != active && !name.empty()) {
      trace.events[name].push_back(event.time_s);
    }
    active = now;
  }
}

void add_line_events(const RunData& data, Trace& trace) {
  add_events_of(InputLine::kKillSwitch, "kill_edge", "kill_release", data, trace);
  for (const auto axis : recorded_axes(data.limits)) {
    for (const bool at_max : {false, true}) {
      add_events_of(protocol::hall_line(axis, at_max), end_stop_event(axis, at_max), {}, data,
                    trace);
    }
    add_events_of(protocol::home_line(axis), home_event(axis), {}, data, trace);
  }
}

void add_events(const RunData& data, Trace& trace) {
  add_line_events(data, trace);
  for (const auto& event : data.events) {
    const bool same_name = event.kind == "fault_latched" || event.kind == "reset" ||
                           event.kind == "motion_started" || event.kind == "motion_ended" ||
                           event.kind == "hard_end_contact";
    if (same_name) {
      trace.events[event.kind].push_back(event.time_s);
    } else if (event.kind == "operator_reset" && event.value != 0) {
      trace.events["reset"].push_back(event.time_s);
    }
  }
  for (auto& [name, times_s] : trace.events) {
    std::sort(times_s.begin(), times_s.end());
  }
}

}  // namespace

std::span<const RunSignal> run_signals() noexcept {
  return kSignals;
}

std::span<const RunEventName> run_event_names() {
  static const auto kEvents = make_events();
  return kEvents;
}

Vocabulary run_vocabulary(std::vector<std::string> windows) {
  Vocabulary vocabulary;
  for (const auto axis : core::kAllAxes) {
    for (const auto& signal : kSignals) {
      vocabulary.signals.push_back(
          {fmt::format("{}_{}", core::name_of(axis), signal.name), std::string(signal.unit)});
    }
  }
  vocabulary.signals.push_back({"fault", "1"});
  for (const auto& event : run_event_names()) {
    vocabulary.events.push_back(event.name);
  }
  vocabulary.windows = std::move(windows);
  return vocabulary;
}

Trace trace_of(const RunData& data, std::map<std::string, TraceWindow> windows) {
  Trace trace;
  trace.windows = std::move(windows);
  const auto time_s = data.log.column("time_s");
  trace.time_s.assign(time_s.begin(), time_s.end());
  const SignalReader reader(data);
  for (const auto axis : core::kAllAxes) {
    for (const auto& signal : kSignals) {
      trace.signals.push_back(reader.read(signal, axis));
    }
  }
  const auto fault = data.log.column("fault");
  trace.signals.emplace_back(fault.begin(), fault.end());
  add_events(data, trace);
  return trace;
}

}  // namespace towbench::harness
