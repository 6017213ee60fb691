#include "harness/record/log_columns.h"

#include <array>
#include <span>
#include <string_view>

namespace towbench::harness {
namespace {

constexpr std::array<std::string_view, 8> kLogColumns{"reference_m",
                                                      "reference_velocity_m_per_s",
                                                      "count",
                                                      "position_m",
                                                      "velocity_m_per_s",
                                                      "duty_pct",
                                                      "state",
                                                      "edges"};

constexpr std::array<std::string_view, 12> kTruthColumns{"motor_angle_rad",
                                                         "motor_speed_rad_per_s",
                                                         "carriage_m",
                                                         "carriage_speed_m_per_s",
                                                         "current_A",
                                                         "motor_torque_Nm",
                                                         "motor_friction_Nm",
                                                         "carriage_friction_N",
                                                         "transmission_force_N",
                                                         "command_V",
                                                         "count",
                                                         "edges_total"};

std::string header(const RecordedAxes& axes, std::span<const std::string_view> columns,
                   std::string_view last) {
  std::string text = "time_s";
  for (const auto axis : axes) {
    for (const auto column : columns) {
      text.append(",").append(core::name_of(axis)).append("_").append(column);
    }
  }
  return text.append(",").append(last);
}

}  // namespace

std::string log_header(const RecordedAxes& axes) {
  return header(axes, kLogColumns, "fault");
}
std::string truth_header(const RecordedAxes& axes) {
  return header(axes, kTruthColumns, "input_lines");
}

void write_log_row(CsvWriter& csv, const LogRow& row, const RecordedAxes& axes) noexcept {
  csv.time(row.time_ns);
  for (const auto which : axes) {
    const auto& axis = row.axes[which];
    csv.number(axis.reference_m)
        .number(axis.reference_velocity_m_per_s)
        .number(axis.count)
        .number(axis.position_m)
        .number(axis.velocity_m_per_s)
        .number(axis.duty_pct)
        .number(static_cast<unsigned>(axis.mode))
        .number(axis.edges);
  }
  csv.number(core::number_of(row.fault)).end_row();
}

void write_truth_row(CsvWriter& csv, const emulator::TruthRow& row,
                     const RecordedAxes& axes) noexcept {
  csv.time(row.time_ns);
  for (const auto which : axes) {
    const auto& axis = row.axes[which];
    csv.number(axis.motor_angle_rad)
        .number(axis.motor_speed_rad_per_s)
        .number(axis.carriage_m)
        .number(axis.carriage_speed_m_per_s)
        .number(axis.current_A)
        .number(axis.motor_torque_Nm)
        .number(axis.motor_friction_Nm)
        .number(axis.carriage_friction_N)
        .number(axis.transmission_force_N)
        .number(axis.command_V)
        .number(axis.count)
        .number(axis.edges_total);
  }
  csv.number(row.input_lines).end_row();
}

}  // namespace towbench::harness
