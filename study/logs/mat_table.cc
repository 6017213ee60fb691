#include "study/logs/mat_table.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "study/logs/mat_process.h"

namespace towbench::study::logs {
namespace {

// The most common length; of two equally common ones the longer.
std::size_t common_length(const std::vector<MatColumn>& columns) {
  std::map<std::size_t, std::size_t> times;
  for (const MatColumn& column : columns) {
    if (column.left_out.empty()) {
      ++times[column.values.size()];
    }
  }
  const auto most = std::max_element(times.begin(), times.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second < b.second : a.first < b.first;
  });
  return most == times.end() ? 0 : most->first;
}

}  // namespace

bool is_mat(std::string_view first_bytes) noexcept {
  return first_bytes.starts_with("MATLAB 5.0 MAT-") || first_bytes.starts_with("MATLAB 7.3 MAT-") ||
         first_bytes.starts_with("\x89HDF\r\n\x1a\n");
}

Table read_mat_table(const std::filesystem::path& path, Findings& findings) {
  Table table;
  std::vector<MatColumn> columns;
  if (const auto wrong = read_mat_apart(path, columns); !wrong.empty()) {
    findings.push_back({Finding::Kind::kFatal, "mat_unreadable", path.string() + ": " + wrong});
    return table;
  }
  const std::size_t length = common_length(columns);
  std::vector<std::string> left_out;
  for (MatColumn& column : columns) {
    if (column.left_out.empty() && column.values.size() != length) {
      column.left_out = fmt::format("has {} numbers, not {}", column.values.size(), length);
    }
    if (column.left_out.empty()) {
      table.names.push_back(std::move(column.name));
      table.columns.push_back(std::move(column.values));
    } else {
      left_out.push_back(column.name + " " + column.left_out);
    }
  }
  if (!left_out.empty()) {
    findings.push_back({Finding::Kind::kNote, "mat_left_out",
                        fmt::format("{}: left out: {}", path.string(), fmt::join(left_out, "; "))});
  }
  if (table.names.size() < 3) {
    findings.push_back({Finding::Kind::kFatal, "header_unusable",
                        fmt::format("{}: {} series of numbers of one length; a log has time, "
                                    "position and input",
                                    path.string(), table.names.size())});
  }
  table.line.resize(length);
  std::iota(table.line.begin(), table.line.end(), 1U);
  return table;
}

}  // namespace towbench::study::logs
