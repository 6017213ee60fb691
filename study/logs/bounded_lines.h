// Lines of a text file, in blocks, whatever ends them: a line feed, or both signs. A file without
// line ends must not fill the memory, so a line has a most length.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace towbench::study::logs {

inline constexpr std::size_t kLongestLine = 1 << 16;

class BoundedLines {
 public:
  explicit BoundedLines(const std::filesystem::path& path);

  // False at the end, or after a line that is too long. The view lives until the next call.
  [[nodiscard]] bool next(std::string_view& line);
  [[nodiscard]] bool opened() const { return opened_; }
  [[nodiscard]] bool line_too_long() const noexcept { return too_long_; }
  // Of the line that next() gave last; the first is 1.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }

 private:
  [[nodiscard]] bool refill();

  std::ifstream file_;
  bool opened_;
  std::string block_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
  bool too_long_ = false;
};

}  // namespace towbench::study::logs
