#include "harness/files/csv_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/files/csv_row.h"
#include "harness/files/regular_file.h"

namespace towbench::harness {
namespace {

std::string read_table(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 33U;  // a day at 1 kHz
  auto text = read_regular_file(path, kLargestRecord_bytes);
  if (const auto* refused = std::get_if<Unreadable>(&text)) {
    throw CsvError(fmt::format("{}: {}", path.string(), refused->what));
  }
  return std::get<std::string>(std::move(text));
}

// Takes the next line from the front of `rest`, which holds whole lines only.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

}  // namespace

CsvTable CsvTable::load(const std::filesystem::path& path) {
  return parse(read_table(path), path);
}

CsvTable CsvTable::parse(std::string_view text, const std::filesystem::path& path) {
  auto table = salvage(text);
  if (table.names_.empty()) {
    throw CsvError(fmt::format("{}: no header row", path.string()));
  }
  for (auto name = table.names_.begin(); name != table.names_.end(); ++name) {
    if (std::find(table.names_.begin(), name, *name) != name) {
      throw CsvError(fmt::format("{}:1: column {} appears twice", path.string(), *name));
    }
  }
  if (!table.first_wrong_.empty()) {
    throw CsvError(fmt::format("{}:{}", path.string(), table.first_wrong_));
  }
  return table;
}

CsvTable CsvTable::salvage(std::string_view text) {
  CsvTable table;
  const std::size_t whole = text.rfind('\n') + 1;  // 0 without any line end
  table.torn_ = whole < text.size();
  text = text.substr(0, whole);
  if (text.empty()) {
    return table;
  }
  std::vector<std::string_view> cells;
  split_csv_row(take_line(text), ',', {}, cells);
  table.names_.assign(cells.begin(), cells.end());
  table.columns_.resize(cells.size());
  for (std::size_t number = 2; !text.empty(); ++number) {
    table.add_row(take_line(text), number, cells);
  }
  return table;
}

void CsvTable::add_row(std::string_view line, std::size_t number,
                       std::vector<std::string_view>& cells) {
  const auto wrong = [&](const std::string& what) {
    if (first_wrong_.empty()) {
      first_wrong_ = fmt::format("{}: {}", number, what);
    }
  };
  split_csv_row(line, ',', {}, cells);
  const std::size_t given = line.empty() ? 0 : cells.size();
  if (given != names_.size()) {
    wrong(fmt::format("{} cells, and the header names {} columns", given, names_.size()));
    refused_rows_ += given == 0 ? 0U : 1U;
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto value = csv_number(cells[i]);
    if (!value) {
      wrong(fmt::format("column {}: '{}' is not a number", names_[i], cells[i]));
      refused_cells_ += cells[i].empty() ? 0U : 1U;
    }
    columns_[i].push_back(value.value_or(kNoNumber));
  }
  ++rows_;
}

CsvTable CsvTable::of(std::map<std::string, std::vector<double>, std::less<>> columns) {
  CsvTable table;
  table.rows_ = columns.empty() ? 0 : columns.begin()->second.size();
  for (auto& [name, values] : columns) {
    table.names_.push_back(name);
    table.columns_.push_back(std::move(values));
  }
  return table;
}

const std::vector<double>* CsvTable::find(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? nullptr
                               : &columns_[static_cast<std::size_t>(found - names_.begin())];
}

std::span<const double> CsvTable::column(std::string_view name) const {
  const auto* values = find(name);
  return values == nullptr ? std::span<const double>{} : *values;
}

std::span<const double> CsvTable::required(std::string_view name,
                                           const std::filesystem::path& file) const {
  if (!has(name)) {
    throw CsvError(fmt::format("{}: no column {}", file.string(), name));
  }
  return column(name);
}

}  // namespace towbench::harness
