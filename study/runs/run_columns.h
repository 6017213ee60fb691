// A run folder's columns as an estimator sees them: log.csv and, at each of its rows, what each
// sensor had last said. truth.csv is never opened.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "study/identify/recording.h"

namespace towbench::study {

// Throws CsvError, naming the file. A latched fault is the recording's trouble.
[[nodiscard]] identify::Recording read_run_columns(const std::filesystem::path& folder);

// The last value at or before each time; 0 before the first. Both times rise.
[[nodiscard]] std::vector<double> held(std::span<const double> time_s,
                                       std::span<const double> values,
                                       std::span<const double> at_s);

}  // namespace towbench::study
