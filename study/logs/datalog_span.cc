#include "study/logs/datalog_span.h"

#include <fmt/format.h>

#include "study/logs/bounded_lines.h"

namespace towbench::study::logs {
namespace {

constexpr std::string_view kBegin = "DATALOG_BEGIN: ";
constexpr std::string_view kEnd = "DATALOG_END";

}  // namespace

DatalogSpan find_datalog(const std::filesystem::path& path, std::string_view axis) {
  DatalogSpan found;
  BoundedLines lines(path);
  std::string_view line;
  bool other_axis = false;
  bool open = false;
  while (lines.next(line)) {
    if (const auto at = line.find(kBegin); at != std::string_view::npos) {
      const auto name = line.substr(at + kBegin.size());
      open = name.substr(0, name.find_last_not_of(" \t\"") + 1) == axis;
      other_axis = other_axis || !open;
      if (open) {
        found.is_datalog = true;
        found.lines.first = lines.number() + 1;
      }
    } else if (open && line.find(kEnd) != std::string_view::npos) {
      found.lines.last = lines.number() - 1;
      open = false;
    }
  }
  if (open) {
    found.wrong =
        fmt::format("{}:{}: a data log without DATALOG_END", path.string(), found.lines.first - 1);
  } else if (other_axis && !found.is_datalog) {
    found.wrong =
        fmt::format("{}: no data log of axis {} (DATALOG_BEGIN: {})", path.string(), axis, axis);
  }
  return found;
}

}  // namespace towbench::study::logs
