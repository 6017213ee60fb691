// A CSV file of numbers, read once, column by column.
//
// Cells are parted by commas, semicolons or tabs, whichever the header has most of; beside the
// latter two a decimal comma is a point. A byte order mark, quotes, lines that begin with # and one
// empty cell too many at the end of a line are taken as they are meant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "study/diagnose/finding.h"

namespace towbench::harness::diagnose {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // NaN where a cell is empty or no number
  std::vector<std::uint32_t> line;           // of each row, in the file
  std::size_t bad_rows = 0;  // with another number of cells than the header: left out

  [[nodiscard]] const std::vector<double>* find(std::string_view name) const noexcept;
  // How often the header has the name: a column that is there twice is not known.
  [[nodiscard]] std::size_t count(std::string_view name) const noexcept;
  [[nodiscard]] std::size_t rows() const noexcept { return line.size(); }
};

// Two million rows: half an hour at 1 kHz, and some gigabytes once it is diagnosed.
inline constexpr std::size_t kMostRows = 2'000'000;

// Streams the file. What cannot be used at all (no file, no header, no rows, rows unlike the
// header, too many rows) is a fatal finding with its line.
[[nodiscard]] Table read_table(const std::filesystem::path& path, Findings& findings);

}  // namespace towbench::harness::diagnose
