// Lines of comma separated cells below a header, wherever they stand in a text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness::procedures {

struct TextTable {
  std::string file;
  std::vector<std::string> names;
  std::vector<std::string> rows;   // as they stand
  std::vector<std::size_t> lines;  // of each row in the file, from 1
  bool is_datalog = false;

  // NaN when the cell is absent or no number as a whole.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
};

// A CSV whose first line names its columns, or what BBMC prints of a data log: the last one of
// `axis` ("y"). Carriage returns and blank lines do not matter. A row with another number of cells
// than the header is refused. Throws FixtureError.
[[nodiscard]] TextTable read_text_table(const std::filesystem::path& path, std::string_view axis);

}  // namespace towbench::harness::procedures
