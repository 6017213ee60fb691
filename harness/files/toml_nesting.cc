#include "harness/files/toml_nesting.h"

#include <algorithm>

namespace towbench::harness {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) noexcept : text_(text) {}

  std::size_t scan() noexcept {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      count(c);
      if (dots_ >= kDeepestToml || depth_ > kDeepestToml) {
        return line_;
      }
      ++at_;
    }
    return 0;
  }

 private:
  void count(char c) noexcept {
    switch (c) {
      case '.':
        ++dots_;
        return;
      case '[':
      case '{':
        ++depth_;
        break;
      case ']':
      case '}':
        depth_ -= depth_ > 0 ? 1U : 0U;
        break;
      case '\n':
        ++line_;
        break;
      case ',':
      case '=':
        break;
      default:
        return;  // part of a key or a value
    }
    dots_ = 0;
  }

  void skip_string(char quote) noexcept {
    const bool is_long = text_.substr(at_, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
    const std::size_t length = is_long ? 3 : 1;
    at_ += length;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\\' && quote == '"') {
        at_ += 2;
        continue;
      }
      if (c == '\n') {
        if (!is_long) {
          return;  // not closed: the parser says so
        }
        ++line_;
      }
      const auto closing = text_.substr(at_, length);
      ++at_;
      if (closing == std::string_view(quote == '"' ? "\"\"\"" : "'''").substr(0, length)) {
        at_ += length - 1;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t dots_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

std::size_t line_nested_too_deep(std::string_view text) noexcept {
  return Scanner(text).scan();
}

}  // namespace towbench::harness
