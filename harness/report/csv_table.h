// A CSV file of numbers as a run leaves it: perhaps with its last line cut off by a kill.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness::report {

struct CsvTable {
  std::vector<std::string> names;            // of the header row
  std::vector<std::vector<double>> columns;  // NaN where a cell is empty or not a number
  std::size_t rows = 0;
  std::size_t refused_rows = 0;   // whole lines whose number of cells is not the header's
  std::size_t refused_cells = 0;  // not empty and not a number
  bool last_line_cut = false;  // it had no line end: its last number may lack digits, so it is out

  [[nodiscard]] const std::vector<double>* find(std::string_view name) const;
};

// Never fails: what cannot be read is counted.
[[nodiscard]] CsvTable parse_csv(std::string_view text);

}  // namespace towbench::harness::report
