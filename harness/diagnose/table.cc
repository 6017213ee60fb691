#include "harness/diagnose/table.h"

#include <charconv>
#include <fstream>
#include <limits>

#include <fmt/format.h>

namespace towbench::harness::diagnose {
namespace {

// Five hours at 1 kHz; beyond it the diagnosis would not end in a useful time.
constexpr std::size_t kMostRows = 20'000'000;
constexpr std::size_t kMostColumns = 512;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return cells;
    }
    line.remove_prefix(comma + 1);
  }
}

double number(std::string_view text) {
  double value = 0;
  const auto* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  const bool whole = result.ec == std::errc{} && result.ptr == end;
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

void tell_fatal(Findings& findings, std::string name, std::string sentence) {
  findings.push_back({Finding::Kind::kFatal, std::move(name), std::move(sentence)});
}

void add_row(Table& table, std::string_view line) {
  const auto cells = cells_of(line);
  if (cells.size() != table.names.size()) {
    ++table.bad_rows;
    return;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double value = number(cells[i]);
    table.bad_cells += (value != value && !cells[i].empty()) ? 1U : 0U;
    table.columns[i].push_back(value);
  }
}

}  // namespace

const std::vector<double>* Table::find(std::string_view name) const noexcept {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      return &columns[i];
    }
  }
  return nullptr;
}

Table read_table(const std::filesystem::path& path, Findings& findings) {
  Table table;
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    tell_fatal(findings, "file_unreadable",
               fmt::format("{}: cannot be opened, or is empty", path.string()));
    return table;
  }
  for (const auto cell : cells_of(line)) {
    table.names.emplace_back(cell);
  }
  if (table.names.size() < 3 || table.names.size() > kMostColumns) {
    tell_fatal(
        findings, "header_unusable",
        fmt::format("{}: the first line has {} columns; a log names time, position and input",
                    path.string(), table.names.size()));
    return table;
  }
  table.columns.resize(table.names.size());
  while (std::getline(file, line)) {
    if (!line.empty() && line != "\r") {
      add_row(table, line);
    }
    if (table.rows() > kMostRows) {
      tell_fatal(findings, "too_long",
                 fmt::format("{}: more than {} rows; cut it into runs of some minutes",
                             path.string(), kMostRows));
      return table;
    }
  }
  if (table.rows() == 0) {
    tell_fatal(findings, "no_rows",
               fmt::format("{}: a header, and nothing below it", path.string()));
  }
  return table;
}

}  // namespace towbench::harness::diagnose
