// Reads a MATLAB file in a process of its own, because matio may not survive a damaged one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/logs/mat_columns.h"

namespace towbench::study::logs {

// What went wrong, for a person; empty when `columns` holds the file.
[[nodiscard]] std::string read_mat_apart(const std::filesystem::path& path,
                                         std::vector<MatColumn>& columns);

}  // namespace towbench::study::logs
