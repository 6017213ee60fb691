#include "harness/metrics/safety_metrics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/checks/recorded_axes.h"
#include "harness/metrics/statistics.h"
#include "protocol/messages.h"

namespace towbench::harness {
namespace {

constexpr double kStateFaulted = 5;  // bbmc::AxisMode::kFaulted
constexpr double kStandstill_m_per_s = 1e-3;

// Value of a truth column at a time between two rows.
double interpolate(std::span<const double> time_s, std::span<const double> values, double at_s) {
  const auto after = std::lower_bound(time_s.begin(), time_s.end(), at_s);
  if (after == time_s.begin()) {
    return values.front();
  }
  if (after == time_s.end()) {
    return values.back();
  }
  const auto i = static_cast<std::size_t>(after - time_s.begin());
  const double share = (at_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

// First moment in the span at which one of the lines of `mask` becomes active.
struct LineEdge {
  double time_s = 0;
  protocol::InputLines line = 0;
};
std::optional<LineEdge> first_edge(const RunData& data, protocol::InputLines mask,
                                   const TimeSpan& span) {
  for (const auto& event : data.events) {
    if (event.kind != "input_line_changed" || !span.holds(event.time_s)) {
      continue;
    }
    // `value` is the number of the line that changed, `lines` all levels after the change.
    const auto changed = protocol::InputLines{1} << static_cast<unsigned>(event.value);
    if ((changed & mask & event.lines) != 0) {
      return LineEdge{event.time_s, changed};
    }
  }
  return std::nullopt;
}

struct HallEdge {
  double time_s = 0;
  double sign = 1;  // towards max or min
};
std::optional<HallEdge> first_hall_edge(const RunData& data, core::Axis axis,
                                        const TimeSpan& span) {
  const auto min = protocol::mask_of(protocol::hall_line(axis, false));
  const auto max = protocol::mask_of(protocol::hall_line(axis, true));
  const auto edge = first_edge(data, min | max, span);
  if (!edge) {
    return std::nullopt;
  }
  return HallEdge{edge->time_s, (edge->line & max) != 0 ? 1.0 : -1.0};
}

bool truth_is_empty(const RunData& data, core::Axis axis) {
  return data.truth_of(axis, "carriage_m").empty() ||
         data.truth_of(axis, "carriage_speed_m_per_s").empty();
}

std::size_t truth_rows_in(const RunData& data, const TimeSpan& span) {
  const auto time_s = data.truth.column("time_s");
  return static_cast<std::size_t>(
      std::count_if(time_s.begin(), time_s.end(), [&](double time) { return span.holds(time); }));
}

// What crosses the wire reaches the amplifier's input later, by less than 100 us (5.2). Only a
// record with a row each 100 us shows it.
constexpr double kCommandPath_s = 1e-4 + 1e-9;

// No axis is commanded from `from_s` on until the kill switch is released.
bool command_stays_zero(const RunData& data, double from_s) {
  const auto time_s = data.truth.column("time_s");
  const auto lines = data.truth.column("input_lines");
  constexpr auto kKill = protocol::mask_of(protocol::InputLine::kKillSwitch);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] <= from_s + kCommandPath_s) {
      continue;
    }
    if ((static_cast<protocol::InputLines>(lines[i]) & kKill) == 0) {
      break;
    }
    for (const auto axis : recorded_axes(data.limits)) {
      const auto command_V = data.truth_of(axis, "command_V");
      if (command_V.empty() || command_V[i] != 0.0) {
        return false;
      }
    }
    ++seen;
  }
  return seen > 0;
}

}  // namespace

MetricValue hall_overrun(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto edge = first_hall_edge(data, axis, span);
  if (!edge || truth_is_empty(data, axis)) {
    return {};
  }
  const auto time_s = data.truth.column("time_s");
  const auto carriage_m = data.truth_of(axis, "carriage_m");
  const double at_edge_m = interpolate(time_s, carriage_m, edge->time_s);
  MetricValue overrun;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] >= edge->time_s && span.holds(time_s[i])) {
      overrun.value = std::max(overrun.value, edge->sign * (carriage_m[i] - at_edge_m));
      ++overrun.samples;
    }
  }
  return overrun;
}

MetricValue hall_entry_speed(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto edge = first_hall_edge(data, axis, span);
  if (!edge || truth_is_empty(data, axis)) {
    return {};
  }
  const double speed_m_per_s = interpolate(
      data.truth.column("time_s"), data.truth_of(axis, "carriage_speed_m_per_s"), edge->time_s);
  return {std::fabs(speed_m_per_s), 1};
}

MetricValue hall_to_standstill_time(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto edge = first_hall_edge(data, axis, span);
  if (!edge || truth_is_empty(data, axis)) {
    return {};
  }
  const auto time_s = data.truth.column("time_s");
  const auto speed = data.truth_of(axis, "carriage_speed_m_per_s");
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] >= edge->time_s && edge->sign * speed[i] < kStandstill_m_per_s) {
      return {time_s[i] - edge->time_s, 1};
    }
  }
  return {};
}

MetricValue hard_end_distance(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.truth.column("time_s");
  const auto carriage_m = data.truth_of(axis, "carriage_m");
  MetricValue nearest;
  for (std::size_t i = 0; i < carriage_m.size(); ++i) {
    if (!span.holds(time_s[i])) {
      continue;
    }
    const double distance_m = std::min(carriage_m[i] - data.limits[axis].hard_min_m,
                                       data.limits[axis].hard_max_m - carriage_m[i]);
    nearest.value = nearest.samples == 0 ? distance_m : std::min(nearest.value, distance_m);
    ++nearest.samples;
  }
  return nearest;
}

MetricValue hard_end_contacts(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto contacts =
      std::count_if(data.events.begin(), data.events.end(), [&](const auto& event) {
        return event.kind == "hard_end_contact" && event.axis == core::name_of(axis) &&
               span.holds(event.time_s);
      });
  return {static_cast<double>(contacts), truth_rows_in(data, span)};
}

MetricValue hard_end_contact_speed(const RunData& data, core::Axis axis, const TimeSpan& span) {
  MetricValue worst{0, truth_rows_in(data, span)};
  for (const auto& event : data.events) {
    if (event.kind == "hard_end_contact" && event.axis == core::name_of(axis) &&
        span.holds(event.time_s)) {
      worst.value = std::max(worst.value, std::fabs(event.value));
    }
  }
  return worst;
}

MetricValue kill_to_zero_duty(const RunData& data, core::Axis /*axis*/, const TimeSpan& span) {
  const auto edge = first_edge(data, protocol::mask_of(protocol::InputLine::kKillSwitch), span);
  if (!edge) {
    return {};
  }
  for (const auto& event : data.events) {
    if (event.side == "wire" && event.kind == "duty_zero" && event.time_s >= edge->time_s) {
      // The plant's row of that moment was written before the message arrived; the next one tells.
      const bool confirmed = command_stays_zero(data, event.time_s);
      return confirmed ? MetricValue{event.time_s - edge->time_s, 1} : MetricValue{};
    }
  }
  return {};
}

MetricValue duty_while_faulted(const RunData& data, core::Axis axis, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto state = data.log_of(axis, "state");
  const auto duty_pct = data.log_of(axis, "duty_pct");
  Statistics statistics;
  for (std::size_t i = 0; i < std::min(state.size(), duty_pct.size()); ++i) {
    if (span.holds(time_s[i]) && state[i] == kStateFaulted) {
      statistics.add(duty_pct[i]);
    }
  }
  return statistics.peak();
}

MetricValue fault_number(const RunData& data, core::Axis /*axis*/, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto fault = data.log.column("fault");
  MetricValue first;
  for (std::size_t i = 0; i < fault.size(); ++i) {
    if (span.holds(time_s[i])) {
      first.value = first.value == 0.0 ? fault[i] : first.value;
      ++first.samples;
    }
  }
  return first;
}

MetricValue fault_at_end(const RunData& data, core::Axis /*axis*/, const TimeSpan& span) {
  const auto time_s = data.log.column("time_s");
  const auto fault = data.log.column("fault");
  MetricValue last;
  for (std::size_t i = 0; i < fault.size(); ++i) {
    if (span.holds(time_s[i])) {
      last = {fault[i], last.samples + 1};
    }
  }
  return last;
}

}  // namespace towbench::harness
