// The files of a run folder that hold what the rig's sensors said, each at its own rate
// (docs/reference/run-folder.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/axis.h"

namespace towbench::harness {

inline constexpr std::string_view kForceFile = "force.csv";
inline constexpr std::string_view kForceHeader =
    "time_s,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm";

[[nodiscard]] inline std::string current_file(core::Axis axis) {
  return "current_" + std::string(core::name_of(axis)) + ".csv";
}
[[nodiscard]] inline std::string current_header(core::Axis axis) {
  return "time_s," + std::string(core::name_of(axis)) + "_current_A";
}
[[nodiscard]] inline std::string absolute_file(core::Axis axis) {
  return "absolute_" + std::string(core::name_of(axis)) + ".csv";
}
[[nodiscard]] inline std::string absolute_header(core::Axis axis) {
  return "time_s," + std::string(core::name_of(axis)) + "_absolute_count";
}
inline constexpr std::string_view kCameraFile = "camera.csv";
[[nodiscard]] inline std::string camera_column(core::Axis axis) {
  return std::string(core::name_of(axis)) + "_camera_m";
}
// All that a run folder may hold.
[[nodiscard]] inline std::vector<std::string> sensor_files() {
  std::vector<std::string> files{std::string(kForceFile)};
  for (const auto axis : core::kAllAxes) {
    files.push_back(current_file(axis));
    files.push_back(absolute_file(axis));
  }
  files.emplace_back(kCameraFile);
  return files;
}

}  // namespace towbench::harness
