// A CSV file of numbers, by column: run folders, reference tables. Lines end in a line feed or in
// both signs. A last line without its end was torn by a kill: its last number may lack digits, so
// it is left out and told.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness {

class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class CsvTable {
 public:
  // Throws CsvError naming file, line and column when a row has another number of cells than the
  // header, or a cell holds no number.
  [[nodiscard]] static CsvTable load(const std::filesystem::path& path);
  // The same of a text that is there already; `path` names it.
  [[nodiscard]] static CsvTable parse(std::string_view text, const std::filesystem::path& path);
  // Never fails: what cannot be read is left out and counted.
  [[nodiscard]] static CsvTable salvage(std::string_view text);

  // Columns that are in memory, all of the same length.
  [[nodiscard]] static CsvTable of(std::map<std::string, std::vector<double>, std::less<>> columns);

  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  // As in the header.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  [[nodiscard]] bool has(std::string_view column) const { return find(column) != nullptr; }
  // Empty when there is no such column.
  [[nodiscard]] std::span<const double> column(std::string_view name) const;
  // Throws CsvError naming `file` when there is no such column.
  [[nodiscard]] std::span<const double> required(std::string_view name,
                                                 const std::filesystem::path& file) const;
  // nullptr when there is no such column.
  [[nodiscard]] const std::vector<double>* find(std::string_view name) const;
  // Whether the file ended inside a row.
  [[nodiscard]] bool torn() const noexcept { return torn_; }
  // Whole lines whose number of cells is not the header's; only of a salvaged table.
  [[nodiscard]] std::size_t refused_rows() const noexcept { return refused_rows_; }
  // Cells that hold something else than a number; an empty one is missing, not wrong. Both are NaN.
  [[nodiscard]] std::size_t refused_cells() const noexcept { return refused_cells_; }

 private:
  void add_row(std::string_view line, std::size_t number, std::vector<std::string_view>& cells);

  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
  std::size_t rows_ = 0;
  std::size_t refused_rows_ = 0;
  std::size_t refused_cells_ = 0;
  std::string first_wrong_;  // "LINE: what is wrong there"; empty: nothing
  bool torn_ = false;
};

}  // namespace towbench::harness
