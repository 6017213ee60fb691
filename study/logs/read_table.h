// A log of any format that the study reads: CSV, MATLAB's MAT, MCAP. The first bytes say which.
#pragma once

#include <filesystem>

#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::logs {

// What cannot be used at all is a fatal finding that names the file and the place in it.
[[nodiscard]] Table read_table(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::study::logs
