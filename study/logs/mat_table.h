// A MATLAB file as a table: the columns of the length that most of them have.
#pragma once

#include <filesystem>
#include <string_view>

#include "study/logs/finding.h"
#include "study/logs/table.h"

namespace towbench::study::logs {

// Whether the first 16 bytes are those of a MAT file of version 5 or 7.3.
[[nodiscard]] bool is_mat(std::string_view first_bytes) noexcept;

// Fatal: mat_unreadable, no_rows. Note: mat_left_out, with each variable that is no column.
[[nodiscard]] Table read_mat_table(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::study::logs
