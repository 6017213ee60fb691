// A tow that another bench logged, as the columns that an estimator sees. A TOML file says which
// column is what:
//
//   schema = 1
//   time = "t"            time_scale_s = 1
//   [y]                                       along the tank; [x] across it, if it moves
//   position = "x"        position_scale_m = 1        metres a unit; or count = "n"
//   reference_velocity = "v"  reference_velocity_scale_m_per_s = 1   optional (tow_list.h:
//   steady_*) duty = "u"            duty_scale_pct = 1          optional, per cent of full drive a
//   unit current = "i"         current_scale_A = 1         optional [force] of the sensor on its
//   mount, tank frame y = "fy"  x = "fx"    scale_N = 1                 x optional; a negative
//   scale turns the sign time = "t"            time_scale_s = 1            of a file of its own;
//   else as the log's
//
// What is documents' (metres a count) comes from the rig. Rows of a log stand at one period.
#pragma once

#include <filesystem>
#include <string>

#include "emulator/rig_parameters.h"
#include "study/identify/recording.h"
#include "study/runs/tow_list.h"

namespace towbench::study {

struct AxisColumns {
  bool named = false;
  std::string position;
  std::string count;
  std::string reference_velocity;
  std::string duty;
  std::string current;
  double position_scale_m = 1;
  double reference_velocity_scale_m_per_s = 1;
  double duty_scale_pct = 1;
  double current_scale_A = 1;
};

struct LogColumns {
  std::filesystem::path file;
  std::string time = "time_s";
  double time_scale_s = 1;
  core::PerPlanarAxis<AxisColumns> axes;
  core::PerPlanarAxis<std::string> force;
  std::string force_time;  // empty: as the log's
  double force_time_scale_s = 1;
  double force_scale_N = 1;
};

// Throws FixtureError.
[[nodiscard]] LogColumns read_log_columns(const std::filesystem::path& path);

// `folder`: what the tow's paths are relative to. Throws FixtureError, one line that names file,
// line and what is wrong: no such column, a cell that is no number, time that does not rise, rows
// missing, neither a reference velocity nor steady stretches.
[[nodiscard]] identify::Recording read_foreign_log(const ListedTow& tow, const LogColumns& columns,
                                                   const std::filesystem::path& folder,
                                                   const emulator::RigParameters& rig);

}  // namespace towbench::study
