// Appends rows of numbers to a CSV file: shortest text that reads back as the same double
// (std::to_chars), no locale, no allocation a row.
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/time.h"

namespace towbench::harness {

// Nanoseconds as seconds, exactly and without trailing zeros: "1.0005". Returns the end of the
// text.
inline constexpr std::size_t kLongestSeconds = 24;
char* write_seconds(char* into, core::Nanoseconds time_ns) noexcept;

class CsvWriter {
 public:
  // Creates the file and writes the header. Throws std::filesystem::filesystem_error.
  CsvWriter(const std::filesystem::path& path, std::string_view header);
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  ~CsvWriter();

  CsvWriter& number(double value) noexcept {
    separate();
    // The values most often met; a shortest conversion costs twenty times as much.
    if (value == 0.0) {
      *cursor_++ = '0';
      return *this;
    }
    cursor_ = std::to_chars(cursor_, limit(), value).ptr;
    return *this;
  }
  // Shortest text that reads back as the same float.
  CsvWriter& number(float value) noexcept {
    separate();
    cursor_ = std::to_chars(cursor_, limit(), value).ptr;
    return *this;
  }
  template <std::integral Integer>
  CsvWriter& number(Integer value) noexcept {
    separate();
    cursor_ = std::to_chars(cursor_, limit(), value).ptr;
    return *this;
  }
  CsvWriter& time(core::Nanoseconds time_ns) noexcept;
  // Every row ends on a line of its own; a kill tears at most the last one.
  void end_row() noexcept;

  // Hands what is buffered to the operating system.
  void flush() noexcept;
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  // False once a write has failed (disk full): the run is then INVALID.
  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  static constexpr std::size_t kBuffer_bytes = 1U << 16U;
  // One row never needs more: 40 columns of at most 26 characters.
  static constexpr std::size_t kLongestRow_bytes = 2048;

  void separate() noexcept {
    if (!row_is_empty_) {
      *cursor_++ = ',';
    }
    row_is_empty_ = false;
  }
  [[nodiscard]] char* limit() noexcept { return buffer_.data() + buffer_.size(); }

  std::vector<char> buffer_;
  char* cursor_;
  int file_ = -1;
  bool row_is_empty_ = true;
  bool good_ = true;
  std::uint64_t rows_ = 0;
};

}  // namespace towbench::harness
