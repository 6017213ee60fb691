// Which column of a foreign log is what, and in which unit. The bench's own names need no map.
//
//   schema = 1            optional
//   time = "t_s"          seconds, or time_scale_s per unit
//   position = "qm_m"     metres, or position_scale_m per unit
//   count = "n"           instead: an encoder's counts; their size is the plant file's or the rig's
//   input = "vir_V"       force, or input_scale_N per unit
//   duty = "u"            instead: per cent of full drive, or duty_scale_pct per unit
//   current = "i"         optional, A: `identify` takes it
//   reference = "qg_m"    optional, same scale as position
//   temperature = "t_C"   optional, of the axis, in kelvin or degrees Celsius
//   input_hold = false    the input is not held for one sample in the baseline model
//   rotary = true         a joint: position in rad, input in Nm
//   [[other]]             another axis of the machine, up to five
//   position = "q2"       metres, or position_scale_m per unit
//   rotary = true         a joint, in rad
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/logs/finding.h"

namespace towbench::study::logs {

struct OtherColumn {
  std::string position;
  double position_scale_m = 1;
  bool rotary = false;
};

struct ColumnMap {
  std::string time = "time_s";
  std::string position;
  std::string count;
  std::string input;
  std::string duty;
  std::string current;
  std::string reference;
  std::string temperature;
  std::vector<OtherColumn> others;
  double time_scale_s = 1;
  double position_scale_m = 1;
  double input_scale_N = 1;
  double duty_scale_pct = 1;
  bool position_is_count = false;  // then the middle of a count is half a count above its number
  std::optional<bool> input_hold;
  bool rotary = false;
};

// Reads a map; unknown keys and wrong types are fatal findings.
[[nodiscard]] ColumnMap read_column_map(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::study::logs
