#include "harness/files/csv_table.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

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

std::vector<std::string> split_header(std::string_view line) {
  std::vector<std::string> names;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    names.emplace_back(line.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

// Parses one row into the ends of `columns`; false when it does not fit them.
bool parse_row(std::string_view line, std::span<std::vector<double>* const> columns) {
  const char* next = line.data();
  const char* const end = line.data() + line.size();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    double value = 0;
    const auto [stop, error] = std::from_chars(next, end, value);
    const bool last = i + 1 == columns.size();
    if (error != std::errc() || (last ? stop != end : stop == end || *stop != ',')) {
      return false;
    }
    columns[i]->push_back(value);
    next = stop + 1;
  }
  return true;
}

}  // namespace

CsvTable CsvTable::load(const std::filesystem::path& path) {
  return parse(read_table(path), path);
}

CsvTable CsvTable::parse(std::string_view text, const std::filesystem::path& path) {
  CsvTable table;
  table.torn_ = text.empty() || text.back() != '\n';
  std::size_t start = text.find('\n');
  if (start == std::string::npos) {
    throw CsvError(fmt::format("{}: no header row", path.string()));
  }
  std::vector<std::vector<double>*> columns;
  for (const auto& name : split_header(text.substr(0, start))) {
    const auto [position, is_new] = table.columns_.try_emplace(name);
    if (!is_new) {
      throw CsvError(fmt::format("{}:1: column {} appears twice", path.string(), name));
    }
    columns.push_back(&position->second);
  }
  ++start;
  for (std::size_t end = text.find('\n', start); end != std::string::npos;
       start = end + 1, end = text.find('\n', start)) {
    if (!parse_row(text.substr(start, end - start), columns)) {
      throw CsvError(
          fmt::format("{}:{}: not {} numbers", path.string(), table.rows_ + 2, columns.size()));
    }
    ++table.rows_;
  }
  return table;
}

CsvTable CsvTable::of(std::map<std::string, std::vector<double>, std::less<>> columns) {
  CsvTable table;
  table.rows_ = columns.empty() ? 0 : columns.begin()->second.size();
  table.columns_ = std::move(columns);
  return table;
}

bool CsvTable::has(std::string_view column) const {
  return columns_.find(column) != columns_.end();
}

std::vector<std::string> CsvTable::names() const {
  std::vector<std::string> names;
  for (const auto& [name, values] : columns_) {
    names.push_back(name);
  }
  return names;
}

std::span<const double> CsvTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  return found == columns_.end() ? std::span<const double>{} : found->second;
}

}  // namespace towbench::harness
