// The last lines typed, oldest first, and where the arrows stand among them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "bbmc/application/console/tokens.h"

namespace towbench::bbmc {

class History {
 public:
  static constexpr std::size_t kLines = 16;

  // An empty line and a repetition of the last one are not worth a place.
  void add(std::string_view line) noexcept {
    steps_back_ = 0;
    if (line.empty() || line.size() > kMaxLineLength || (count_ > 0 && back(1) == line)) {
      return;
    }
    Entry& entry = entries_[next_];
    std::copy(line.begin(), line.end(), entry.text.begin());
    entry.size = line.size();
    next_ = (next_ + 1) % kLines;
    count_ = std::min(count_ + 1, kLines);
  }

  // The line before the one shown; the oldest stays.
  [[nodiscard]] std::string_view older() noexcept {
    steps_back_ = std::min(steps_back_ + 1, count_);
    return back(steps_back_);
  }

  // The line after the one shown; after the newest, an empty one.
  [[nodiscard]] std::string_view newer() noexcept {
    steps_back_ -= std::min<std::size_t>(steps_back_, 1);
    return back(steps_back_);
  }

 private:
  struct Entry {
    std::array<char, kMaxLineLength> text{};
    std::size_t size = 0;
  };

  [[nodiscard]] std::string_view back(std::size_t steps) const noexcept {
    if (steps == 0) {
      return {};
    }
    const Entry& entry = entries_[(next_ + kLines - steps) % kLines];
    return {entry.text.data(), entry.size};
  }

  std::array<Entry, kLines> entries_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::size_t steps_back_ = 0;
};

}  // namespace towbench::bbmc
