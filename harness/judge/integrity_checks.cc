#include "harness/judge/integrity_checks.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "harness/metrics/motion_metrics.h"

namespace towbench::harness {
namespace {

constexpr double kSameTime_s = 1e-9;
// Mean speed over the record's last stretch.
constexpr double kStandstill_m_per_s = 5e-3;

Check named(std::string name, std::string meaning, std::string reason) {
  Check check;
  check.name = std::move(name);
  check.meaning = std::move(meaning);
  check.verdict = reason.empty() ? Verdict::kPass : Verdict::kInvalid;
  check.reason = std::move(reason);
  return check;
}

// Empty when rows stand exactly one period apart and reach the end.
std::string gaps_in(std::span<const double> time_s, core::Nanoseconds period_ns,
                    core::Nanoseconds end_ns, core::Nanoseconds late_ns = 0) {
  if (time_s.empty()) {
    return "there is no row";
  }
  const double period_s = core::seconds(period_ns);
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (std::fabs(time_s[i] - time_s[i - 1] - period_s) > kSameTime_s) {
      return fmt::format("row {} is at {} s, {} s after the one before; expected {} s", i + 1,
                         time_s[i], time_s[i] - time_s[i - 1], period_s);
    }
  }
  if (time_s.front() > period_s + core::seconds(late_ns) + kSameTime_s) {
    return fmt::format("the first row is at {} s", time_s.front());
  }
  if (time_s.back() + period_s <= core::seconds(end_ns + late_ns) - kSameTime_s) {
    return fmt::format("the last row is at {} s, the run ended at {} s", time_s.back(),
                       core::seconds(end_ns));
  }
  return {};
}

std::string not_finite_in(const CsvTable& table) {
  auto names = table.names();
  std::sort(names.begin(), names.end());  // of several always the same, from a file or from memory
  for (const auto& name : names) {
    const auto column = table.column(name);
    if (!std::all_of(column.begin(), column.end(), [](double x) { return std::isfinite(x); })) {
      return fmt::format("column {} holds a value that is not finite", name);
    }
  }
  return {};
}

std::string why_log_incomplete(const RunData& data, const ExpectedRecord& expected) {
  if (!expected.writes_succeeded) {
    return "a file could not be written";
  }
  if (expected.rows_lost > 0) {
    return fmt::format("{} rows were lost", expected.rows_lost);
  }
  if (data.log.torn()) {
    return "the last row is torn";
  }
  const auto gaps = gaps_in(data.log.column("time_s"), expected.control_period_ns, expected.end_ns);
  return gaps.empty() ? not_finite_in(data.log) : gaps;
}

std::string why_sensor_incomplete(const RunData& data, const ExpectedRecord& expected,
                                  const ExpectedSensor& sensor) {
  const auto found = data.sensors.find(sensor.file);
  if (found == data.sensors.end()) {
    return "the file is missing";
  }
  if (found->second.torn()) {
    return "the last row is torn";
  }
  // A plant that is heard once an exchange may end that much before the controller.
  const auto slack_ns = std::max<core::Nanoseconds>(0, expected.exchange_ns - sensor.period_ns);
  const auto gaps = gaps_in(found->second.column("time_s"), sensor.period_ns,
                            expected.end_ns - slack_ns, sensor.late_ns);
  return gaps.empty() ? not_finite_in(found->second) : gaps;
}

std::string why_truth_incomplete(const RunData& data, const ExpectedRecord& expected) {
  if (data.truth.torn()) {
    return "the last row is torn";
  }
  const auto gaps = gaps_in(data.truth.column("time_s"), expected.exchange_ns, expected.end_ns);
  return gaps.empty() ? not_finite_in(data.truth) : gaps;
}

}  // namespace

Check check_log_complete(const RunData& data, const ExpectedRecord& expected) {
  return named("log_complete", "log.csv has every control tick",
               why_log_incomplete(data, expected));
}

Check check_truth_complete(const RunData& data, const ExpectedRecord& expected) {
  return named("truth_complete", "truth.csv has every exchange",
               why_truth_incomplete(data, expected));
}

Check check_sensor_complete(const RunData& data, const ExpectedRecord& expected,
                            const ExpectedSensor& sensor) {
  return named(std::filesystem::path(sensor.file).stem().string() + "_complete",
               sensor.file + " has every sample", why_sensor_incomplete(data, expected, sensor));
}

Check check_edges_seen(const RunData& data) {
  constexpr double kMoved_counts = 10;
  std::string reason;
  double edges_of_all = 0;
  for (const auto axis : core::kAllAxes) {
    const auto edges = edges_total(data, axis, {});
    edges_of_all += edges.value;
    const double travel_m = carriage_travel(data, axis, {}).value;
    const bool moved = travel_m > kMoved_counts * data.limits[axis].metres_per_count;
    if (data.limits[axis].exists && moved && edges.value == 0.0) {
      reason = fmt::format("{} moved {:.3g} m and the controller's decoder saw no edge",
                           core::name_of(axis), travel_m);
    }
  }
  if (reason.empty() && edges_of_all == 0.0) {
    reason = "the controller's decoder saw no edge on any axis";
  }
  return named("edges_seen", "the controller's quadrature decoder saw the motion", reason);
}

Check check_comes_to_rest(const RunData& data) {
  constexpr double kStretch_s = 0.1;  // about a period of the slowest transmission
  const auto time_s = data.truth.column("time_s");
  std::string reason;
  if (!time_s.empty()) {
    const auto first = static_cast<std::size_t>(
        std::lower_bound(time_s.begin(), time_s.end(), time_s.back() - kStretch_s) -
        time_s.begin());
    const double length_s = std::max(time_s.back() - time_s[first], kSameTime_s);
    for (const auto axis : core::kAllAxes) {
      const auto speed = [&](std::string_view column, double scale) {
        const auto values = data.truth_of(axis, column);
        return values.size() == time_s.size()
                   ? std::fabs(values.back() - values[first]) * scale / length_s
                   : 0.0;
      };
      const double faster =
          std::max(speed("carriage_m", 1.0), speed("count", data.limits[axis].metres_per_count));
      if (data.limits[axis].exists && faster > kStandstill_m_per_s) {
        reason = fmt::format("{} still moves at {:.3g} m/s when the record ends",
                             core::name_of(axis), faster);
      }
    }
  }
  return named("comes_to_rest", "the machine stands when the record ends", reason);
}

Check check_events_fired(const RunData& data, const ExpectedRecord& expected) {
  const auto fired = std::count_if(data.events.begin(), data.events.end(), [](const auto& event) {
    return event.kind == "scheduled_event_fired";
  });
  std::string reason;
  if (expected.unreached_events > 0) {
    reason = fmt::format("the run ended before {} scheduled event(s)", expected.unreached_events);
  } else if (static_cast<std::size_t>(fired) != expected.scheduled_events) {
    reason = fmt::format("{} of {} scheduled events took place", fired, expected.scheduled_events);
  }
  return named("events_fired", "every scheduled event took place", reason);
}

}  // namespace towbench::harness
