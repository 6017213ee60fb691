#include "study/procedures/text_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness::procedures {
namespace {

constexpr std::size_t kMostRows = 5'000'000;
constexpr std::string_view kBegin = "DATALOG_BEGIN: ";
constexpr std::string_view kEnd = "DATALOG_END";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::string_view cell(std::string_view row, std::size_t column) {
  for (; column > 0; --column) {
    const auto comma = row.find(',');
    if (comma == std::string_view::npos) {
      return {};
    }
    row.remove_prefix(comma + 1);
  }
  return trimmed(row.substr(0, row.find(',')));
}

std::size_t cells(std::string_view row) {
  return 1 + static_cast<std::size_t>(std::count(row.begin(), row.end(), ','));
}

struct Line {
  std::size_t number = 0;
  std::string text;
};

std::vector<Line> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw FixtureError({.file = path.string()}, "cannot be read",
                       "a run folder, a data log or a CSV file");
  }
  std::vector<Line> lines;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    if (const auto line = trimmed(text); !line.empty()) {
      lines.push_back({number, std::string(line)});
    }
    if (lines.size() > kMostRows) {
      throw FixtureError({.file = path.string(), .line = number},
                         fmt::format("more than {} rows", kMostRows), "a log of some minutes");
    }
  }
  return lines;
}

}  // namespace

double TextTable::number(std::size_t row, std::size_t column) const {
  const auto text = cell(rows[row], column);
  double value = 0;
  const auto* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  return !text.empty() && read.ec == std::errc{} && read.ptr == end
             ? value
             : std::numeric_limits<double>::quiet_NaN();
}

TextTable read_text_table(const std::filesystem::path& path, std::string_view axis) {
  auto lines = lines_of(path);
  TextTable table;
  table.file = path.string();
  // The last data log of the axis, if there is any.
  std::size_t from = 0;
  std::size_t to = lines.size();
  bool other_axis = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto at = lines[i].text.find(kBegin);
    if (at == std::string::npos) {
      continue;
    }
    if (trimmed(std::string_view(lines[i].text).substr(at + kBegin.size())) == axis) {
      table.is_datalog = true;
      from = i + 1;
      to = from;
      while (to < lines.size() && lines[to].text.find(kEnd) == std::string::npos) {
        ++to;
      }
      if (to == lines.size()) {
        throw FixtureError({.file = table.file, .line = lines[i].number},
                           "a data log without DATALOG_END", "a whole one");
      }
    } else {
      other_axis = true;
    }
  }
  if (other_axis && !table.is_datalog) {
    throw FixtureError({.file = table.file}, fmt::format("no data log of axis {}", axis),
                       "DATALOG_BEGIN: " + std::string(axis));
  }
  if (from >= to) {
    throw FixtureError({.file = table.file}, "nothing in it", "a header and rows");
  }
  const auto head = cells(lines[from].text);
  for (std::size_t i = 0; i < head; ++i) {
    table.names.emplace_back(cell(lines[from].text, i));
  }
  for (std::size_t i = from + 1; i < to; ++i) {
    if (cells(lines[i].text) != head) {
      throw FixtureError({.file = table.file, .line = lines[i].number},
                         fmt::format("{} cells", cells(lines[i].text)),
                         fmt::format("{}, as in the header", head));
    }
    table.rows.push_back(std::move(lines[i].text));
    table.lines.push_back(lines[i].number);
  }
  return table;
}

}  // namespace towbench::harness::procedures
