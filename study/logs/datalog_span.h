// Where BBMC's data log of an axis stands in the text of a console.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace towbench::study::logs {

// Lines of a file, the first is 1; `last` belongs to them.
struct LineSpan {
  std::size_t first = 1;
  std::size_t last = std::numeric_limits<std::size_t>::max();
};

struct DatalogSpan {
  bool is_datalog = false;
  LineSpan lines;     // of the last data log of the axis; all lines when there is none
  std::string wrong;  // "FILE:LINE: ...", when there is one of another axis alone, or half of one
};

[[nodiscard]] DatalogSpan find_datalog(const std::filesystem::path& path, std::string_view axis);

}  // namespace towbench::study::logs
