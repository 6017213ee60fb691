// A log of numbers, column by column: what every format of log becomes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::study::logs {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // NaN where a cell is empty or no number
  std::vector<std::uint32_t> line;           // of each row, in the file: its line, or its number
  std::size_t bad_rows = 0;  // with another number of cells than the header: left out
  std::size_t first_bad_line = 0;
  std::size_t first_bad_cells = 0;

  [[nodiscard]] const std::vector<double>* find(std::string_view name) const noexcept;
  // How often the header has the name: a column that is there twice is not known.
  [[nodiscard]] std::size_t count(std::string_view name) const noexcept;
  [[nodiscard]] std::size_t rows() const noexcept { return line.size(); }
};

// Two million rows: half an hour at 1 kHz, and some gigabytes once it is diagnosed.
inline constexpr std::size_t kMostRows = 2'000'000;
inline constexpr std::size_t kMostColumns = 512;

}  // namespace towbench::study::logs
