// A log that a user brings, as the recording of one axis that estimators take.
//
//   run folder            its log.csv; truth.csv is never opened
//   BBMC's data log       the text of `datalog print`, console and all: DATALOG_BEGIN ..
//   DATALOG_END any CSV               with a column map, a TOML file of these keys:
//     time = "t"          time_scale_s = 1        seconds a unit
//     count = "n"         or position = "x" with position_scale_m = 1, metres a unit
//     duty = "u"          duty_scale_pct = 1      per cent of full drive a unit
//     current = "i"       optional, A
//
// What is documents' (metres a count, rows of an encoder) comes from the rig.
#pragma once

#include <filesystem>
#include <string>

#include "study/identify/recording.h"
#include "study/procedures/machine.h"

namespace towbench::harness::procedures {

struct BroughtLog {
  identify::Recording recording;
  std::string source;  // "datalog of y, 8000 rows", for a person
};

// Throws FixtureError, one line that names file, line and what is wrong: no such column, a cell
// that is no number, time that does not rise, an axis that never moves or is never driven, fewer
// than 1000 rows, rows missing.
[[nodiscard]] BroughtLog read_brought_log(const std::filesystem::path& data,
                                          const std::filesystem::path& columns, core::Axis axis,
                                          const Nameplate& plate);

}  // namespace towbench::harness::procedures
