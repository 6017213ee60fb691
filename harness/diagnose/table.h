// A CSV file of numbers, read once, column by column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/diagnose/finding.h"

namespace towbench::harness::diagnose {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // NaN where a cell is empty or no number
  std::size_t bad_cells = 0;
  std::size_t bad_rows = 0;  // with another number of cells than the header: left out

  [[nodiscard]] const std::vector<double>* find(std::string_view name) const noexcept;
  [[nodiscard]] std::size_t rows() const noexcept {
    return columns.empty() ? 0 : columns.front().size();
  }
};

// Streams the file, so its size is bounded by the columns kept, not by its text. What cannot be
// used at all (no file, no header, no rows, too many rows) is a fatal finding.
[[nodiscard]] Table read_table(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::harness::diagnose
