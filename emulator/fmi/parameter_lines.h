// A parameter struct as lines of "dotted.key value ...", written and read through its visit()
// (core/parameter.h), bit for bit.
#pragma once

#include <charconv>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/bounded_vector.h"
#include "core/parameter.h"

namespace towbench::fmi3 {

class PathOfKeys {
 public:
  template <typename Visitor, typename Nested>
  void group(Visitor& visitor, std::string_view key, Nested& nested) {
    const auto above = path_.size();
    path_ += std::string(key) + '.';
    nested.visit(visitor);
    path_.resize(above);
  }
  [[nodiscard]] std::string of(std::string_view key) const { return path_ + std::string(key); }

 private:
  std::string path_;
};

class LineWriter {
 public:
  template <typename T>
  void value(std::string_view key, T& field, core::Range /*range*/, std::string_view /*meaning*/) {
    add(key, {number_of(field)});
  }
  template <std::size_t Capacity>
  void list(std::string_view key, core::BoundedVector<double, Capacity>& field,
            core::Range /*range*/, std::string_view /*meaning*/) {
    add(key, {field.begin(), field.end()});
  }
  template <typename Nested>
  void group(std::string_view key, Nested& nested, std::string_view /*meaning*/) {
    path_.group(*this, key, nested);
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  // No integer of a parameter set is beyond what a double holds.
  template <typename T>
  [[nodiscard]] static double number_of(T value) {
    return static_cast<double>(value);
  }
  void add(std::string_view key, const std::vector<double>& numbers) {
    text_ += path_.of(key);
    for (const double number : numbers) {
      char digits[32];
      const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
      text_ += ' ';
      text_.append(digits, end);
    }
    text_ += '\n';
  }

  PathOfKeys path_;
  std::string text_;
};

class LineReader {
 public:
  explicit LineReader(std::string_view text);

  template <typename T>
  void value(std::string_view key, T& field, core::Range /*range*/, std::string_view /*meaning*/) {
    const auto& numbers = take(key);
    complete_ = complete_ && numbers.size() == 1;
    if (numbers.size() == 1) {
      field =
          std::is_same_v<T, bool> ? static_cast<T>(numbers[0] != 0) : static_cast<T>(numbers[0]);
    }
  }
  template <std::size_t Capacity>
  void list(std::string_view key, core::BoundedVector<double, Capacity>& field,
            core::Range /*range*/, std::string_view /*meaning*/) {
    const auto& numbers = take(key);
    field.clear();
    complete_ = complete_ && numbers.size() <= Capacity && field.assign(numbers);
  }
  template <typename Nested>
  void group(std::string_view key, Nested& nested, std::string_view /*meaning*/) {
    path_.group(*this, key, nested);
  }
  // Every key that was asked for was there, and every number was one.
  [[nodiscard]] bool complete() const noexcept { return complete_; }

 private:
  [[nodiscard]] const std::vector<double>& take(std::string_view key);

  PathOfKeys path_;
  std::map<std::string, std::vector<double>> lines_;
  bool complete_ = true;
};

inline LineReader::LineReader(std::string_view text) {
  while (!text.empty()) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() < text.size() ? line.size() + 1 : line.size());
    auto& numbers = lines_[std::string(line.substr(0, line.find(' ')))];
    for (auto at = line.find(' '); at != std::string_view::npos; at = line.find(' ', at + 1)) {
      double number = 0;
      const auto read = std::from_chars(line.data() + at + 1, line.data() + line.size(), number);
      complete_ = complete_ && read.ec == std::errc{};
      numbers.push_back(number);
    }
  }
}

inline const std::vector<double>& LineReader::take(std::string_view key) {
  static const std::vector<double> kNone;
  const auto found = lines_.find(path_.of(key));
  complete_ = complete_ && found != lines_.end();
  return found == lines_.end() ? kNone : found->second;
}

}  // namespace towbench::fmi3
