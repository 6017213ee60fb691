// A log that a user brings, as the recording of one axis that estimators take.
//
//   run folder            its log.csv; truth.csv is never opened
//   BBMC's data log       the text of `datalog print`, console and all
//   any other log         CSV, MAT or MCAP, with a column map (study/logs/column_map.h) of time,
//                         count or position, duty, perhaps current
//
// What is documents' (metres a count, rows of an encoder) comes from the rig.
#pragma once

#include <filesystem>
#include <string>

#include "study/identify/recording.h"
#include "study/procedures/machine.h"

namespace towbench::study::procedures {

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

}  // namespace towbench::study::procedures
