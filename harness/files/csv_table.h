// A CSV file of numbers, by column: what the judge and the replay read back.
#pragma once

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
  // A last line without its end was torn by a kill and is left out. Throws CsvError naming file and
  // line when a row has another number of fields than the header or holds something not a number.
  [[nodiscard]] static CsvTable load(const std::filesystem::path& path);
  // The same of a text that is there already; `path` names it.
  [[nodiscard]] static CsvTable parse(std::string_view text, const std::filesystem::path& path);

  // Columns that are in memory, all of the same length.
  [[nodiscard]] static CsvTable of(std::map<std::string, std::vector<double>, std::less<>> columns);

  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] bool has(std::string_view column) const;
  [[nodiscard]] std::vector<std::string> names() const;
  // Empty when there is no such column.
  [[nodiscard]] std::span<const double> column(std::string_view name) const;
  // Whether the file ended inside a row.
  [[nodiscard]] bool torn() const noexcept { return torn_; }

 private:
  std::map<std::string, std::vector<double>, std::less<>> columns_;
  std::size_t rows_ = 0;
  bool torn_ = false;
};

}  // namespace towbench::harness
