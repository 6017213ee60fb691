// Text into storage of the caller, never beyond it: the only way BBMC's application layer prints.
//
// No heap, no locale, no printf: it must build for bare metal, and a number looks the same on
// every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace towbench::bbmc {

class TextWriter {
 public:
  explicit TextWriter(std::span<char> storage) noexcept : storage_(storage) {}

  TextWriter& text(std::string_view text) noexcept;
  TextWriter& integer(std::int64_t value) noexcept;

  // `decimals` 0 .. 12 digits after the point, the nearest value (ties away from zero); nan and inf
  // by name; above 2^63 with an exponent.
  TextWriter& fixed(double value, int decimals) noexcept;

  // The same, with the zeros at the end of the fraction left out: 0.4, 20, 0.
  TextWriter& compact(double value, int max_decimals) noexcept;

  // Spaces up to column `column`, counted from the last end of line; at least one.
  TextWriter& column(std::size_t column) noexcept;

  // CR LF, as terminals on a UART expect.
  TextWriter& end_line() noexcept;

  [[nodiscard]] std::string_view view() const noexcept { return {storage_.data(), size_}; }
  // Something did not fit and was left out.
  [[nodiscard]] bool truncated() const noexcept { return truncated_; }
  void clear() noexcept;

 private:
  void put(char character) noexcept;
  void unsigned_digits(std::uint64_t value, int min_digits) noexcept;

  std::span<char> storage_;
  std::size_t size_ = 0;
  std::size_t line_start_ = 0;
  bool truncated_ = false;
};

}  // namespace towbench::bbmc
