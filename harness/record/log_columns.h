// The rows of log.csv and truth.csv: the header, and how a row is written. README.md is the spec.
#pragma once

#include <string>

#include "emulator/truth_row.h"
#include "harness/checks/recorded_axes.h"
#include "harness/lockstep/log_row.h"
#include "harness/record/csv_writer.h"

namespace towbench::harness {

[[nodiscard]] std::string log_header(const RecordedAxes& axes = planar_axes());
[[nodiscard]] std::string truth_header(const RecordedAxes& axes = planar_axes());

void write_log_row(CsvWriter& csv, const LogRow& row,
                   const RecordedAxes& axes = planar_axes()) noexcept;
void write_truth_row(CsvWriter& csv, const emulator::TruthRow& row,
                     const RecordedAxes& axes = planar_axes()) noexcept;

}  // namespace towbench::harness
