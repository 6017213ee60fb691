// The EMPS recordings (Janot, Gautier, Brunot 2019), which name no licence and stay outside.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "study/diagnose/run_reader.h"
#include "study/logs/read_table.h"

namespace towbench::tests {

// TOWBENCH_EMPS, or ../shared/data/emps beside the project; tests run from the project's root.
[[nodiscard]] inline std::filesystem::path emps_folder() {
  const char* given = std::getenv("TOWBENCH_EMPS");
  return given != nullptr ? std::filesystem::path(given)
                          : std::filesystem::path("../shared/data/emps");
}

[[nodiscard]] inline bool emps_is_there() {
  return std::filesystem::exists(emps_folder() / "DATA_EMPS.csv");
}

// Force = 35.15065 N/V times the controller's output.
[[nodiscard]] inline study::diagnose::Run emps_run(const std::string& file) {
  study::logs::ColumnMap map;
  map.time = "t_s";
  map.position = "qm_m";
  map.input = "vir_V";
  map.reference = "qg_m";
  map.input_scale_N = 35.15065;
  study::logs::Findings findings;
  const auto table = study::logs::read_table(emps_folder() / file, findings);
  return study::diagnose::make_run(table, map, file, findings);
}

}  // namespace towbench::tests
