// The rows of log.csv and truth.csv: the header, and how a row is written. README.md is the spec.
#pragma once

#include <string>

#include "bbmc/system/telemetry_row.h"
#include "emulator/truth_row.h"
#include "harness/record/csv_writer.h"

namespace towbench::harness {

[[nodiscard]] std::string log_header();
[[nodiscard]] std::string truth_header();

void write_log_row(CsvWriter& csv, const bbmc::TelemetryRow& row) noexcept;
void write_truth_row(CsvWriter& csv, const emulator::TruthRow& row) noexcept;

}  // namespace towbench::harness
