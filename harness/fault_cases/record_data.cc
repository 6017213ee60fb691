#include "harness/fault_cases/record_data.h"

#include <optional>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

using Columns = std::map<std::string, std::vector<double>, std::less<>>;

template <typename Rows, typename Of>
void add(Columns& columns, const std::string& name, const Rows& rows, Of of) {
  auto& column = columns[name];
  column.reserve(rows.size());
  for (const auto& row : rows) {
    column.push_back(static_cast<double>(of(row)));
  }
}

Columns log_columns(const CaseRecord& record) {
  Columns columns;
  const auto& rows = record.log;
  add(columns, "time_s", rows, [](const auto& row) { return core::seconds(row.time_ns); });
  add(columns, "fault", rows, [](const auto& row) { return core::number_of(row.fault); });
  for (const auto axis : core::kAllAxes) {
    const auto add_of_axis = [&](const char* name, auto field) {
      add(columns, fmt::format("{}_{}", core::name_of(axis), name), rows,
          [&](const LogRow& row) { return row.axes[axis].*field; });
    };
    add_of_axis("reference_m", &bbmc::AxisTelemetry::reference_m);
    add_of_axis("position_m", &bbmc::AxisTelemetry::position_m);
    add_of_axis("velocity_m_per_s", &bbmc::AxisTelemetry::velocity_m_per_s);
    add_of_axis("duty_pct", &bbmc::AxisTelemetry::duty_pct);
    add_of_axis("state", &bbmc::AxisTelemetry::mode);
  }
  return columns;
}

Columns truth_columns(const CaseRecord& record) {
  Columns columns;
  const auto& rows = record.truth;
  add(columns, "time_s", rows, [](const auto& row) { return core::seconds(row.time_ns); });
  for (const auto axis : core::kAllAxes) {
    const auto add_of_axis = [&](const char* name, auto field) {
      add(columns, fmt::format("{}_{}", core::name_of(axis), name), rows,
          [&](const KeptTruth& row) { return row.axes[axis].*field; });
    };
    add_of_axis("carriage_m", &emulator::AxisTruth::carriage_m);
    add_of_axis("carriage_speed_m_per_s", &emulator::AxisTruth::carriage_speed_m_per_s);
    add_of_axis("motor_speed_rad_per_s", &emulator::AxisTruth::motor_speed_rad_per_s);
    add_of_axis("current_A", &emulator::AxisTruth::current_A);
    add_of_axis("command_V", &emulator::AxisTruth::command_V);
    add_of_axis("transmission_force_N", &emulator::AxisTruth::transmission_force_N);
  }
  return columns;
}

std::optional<const char*> name_of(emulator::PlantEventKind kind) {
  switch (kind) {
    case emulator::PlantEventKind::kInputLineChanged:
      return "input_line_changed";
    case emulator::PlantEventKind::kHardEndContact:
      return "hard_end_contact";
    case emulator::PlantEventKind::kOperatorReset:
      return "operator_reset";
    default:
      return std::nullopt;
  }
}

std::optional<const char*> name_of(bbmc::ControllerEvent::Kind kind) {
  using Happened = bbmc::ControllerEvent::Kind;
  switch (kind) {
    case Happened::kFaultLatched:
      return "fault_latched";
    case Happened::kReset:
      return "reset";
    case Happened::kMotionStarted:
      return "motion_started";
    case Happened::kMotionEnded:
      return "motion_ended";
    default:
      return std::nullopt;
  }
}

}  // namespace

RunData run_data_of(const CaseRecord& record, const core::PerAxis<AxisLimits>& limits) {
  RunData data;
  data.log = CsvTable::of(log_columns(record));
  data.truth = CsvTable::of(truth_columns(record));
  data.limits = limits;
  const auto add_event = [&](core::Nanoseconds time_ns, const char* kind) -> RunEvent& {
    auto& event = data.events.emplace_back();
    event.time_s = core::seconds(time_ns);
    event.kind = kind;
    return event;
  };
  for (const auto& event : record.plant_events) {
    if (const auto name = name_of(event.kind)) {
      auto& added = add_event(event.time_ns, *name);
      added.lines = event.lines;
      added.value = event.value;
    }
  }
  for (const auto& event : record.controller_events) {
    if (const auto name = name_of(event.kind)) {
      (void)add_event(event.time_ns, *name);
    }
  }
  return data;
}

}  // namespace towbench::harness
