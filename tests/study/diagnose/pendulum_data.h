// A real joint with gravity: the torque-limited simple pendulum of DFKI (BSD 3-Clause), whose data
// stay outside.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "study/diagnose/run_reader.h"
#include "study/logs/read_table.h"

namespace towbench::tests {

// TOWBENCH_PENDULUM, or ../shared/data/dfki_pendulum beside the project.
[[nodiscard]] inline std::filesystem::path pendulum_folder() {
  const char* given = std::getenv("TOWBENCH_PENDULUM");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path("../shared/data/dfki_pendulum");
}

[[nodiscard]] inline bool pendulum_is_there() {
  return std::filesystem::exists(pendulum_folder() / "ddp.csv");
}

[[nodiscard]] inline study::diagnose::Run pendulum_run(const std::string& file,
                                                       study::logs::Findings& findings) {
  study::logs::ColumnMap map;
  map.position = "position_rad";
  map.input = "torque_Nm";
  map.rotary = true;
  const auto table = study::logs::read_table(pendulum_folder() / (file + ".csv"), findings);
  return study::diagnose::make_run(table, map, file, findings);
}

}  // namespace towbench::tests
