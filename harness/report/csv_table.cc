#include "harness/report/csv_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace towbench::harness::report {
namespace {

constexpr double kEmptyCell = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view cell) {
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) {
    cell.remove_prefix(1);
  }
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) {
    cell.remove_suffix(1);
  }
  return cell;
}

// Takes the text up to `separator` from the front of `rest`, and the separator with it.
std::string_view take(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view head = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return head;
}

double number_in(std::string_view cell, std::size_t& refused_cells) {
  cell = trimmed(cell);
  if (cell.empty()) {
    return kEmptyCell;
  }
  double value = kEmptyCell;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) {
    ++refused_cells;
    return kEmptyCell;
  }
  return value;
}

void append_row(CsvTable& table, std::string_view line) {
  const auto cells = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  if (cells != table.names.size()) {
    ++table.refused_rows;
    return;
  }
  for (auto& column : table.columns) {
    column.push_back(number_in(take(line, ','), table.refused_cells));
  }
  ++table.rows;
}

}  // namespace

const std::vector<double>* CsvTable::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

CsvTable parse_csv(std::string_view text) {
  CsvTable table;
  const std::size_t last_line_end = text.rfind('\n');
  const std::size_t whole = last_line_end == std::string_view::npos ? 0 : last_line_end + 1;
  table.last_line_cut = whole < text.size();
  text = text.substr(0, whole);

  std::string_view header = trimmed(take(text, '\n'));
  while (!header.empty()) {
    table.names.emplace_back(trimmed(take(header, ',')));
  }
  table.columns.resize(table.names.size());
  while (!text.empty()) {
    const std::string_view line = trimmed(take(text, '\n'));
    if (!line.empty()) {
      append_row(table, line);
    }
  }
  return table;
}

}  // namespace towbench::harness::report
