#include "bbmc/application/console/text_writer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace towbench::bbmc {
namespace {

constexpr int kMaxDecimals = 12;
// From here on a double is an integer anyway, and one that std::uint64_t cannot hold soon after.
constexpr double kFixedLimit = 0x1p63;

constexpr std::uint64_t power_of_ten(int exponent) noexcept {
  std::uint64_t power = 1;
  for (int i = 0; i < exponent; ++i) {
    power *= 10U;
  }
  return power;
}

}  // namespace

void TextWriter::put(char character) noexcept {
  if (size_ == storage_.size()) {
    truncated_ = true;
    return;
  }
  storage_[size_++] = character;
}

TextWriter& TextWriter::text(std::string_view text) noexcept {
  for (const char character : text) {
    put(character);
  }
  return *this;
}

void TextWriter::unsigned_digits(std::uint64_t value, int min_digits) noexcept {
  std::array<char, 20> digits{};
  int count = 0;
  do {
    digits[static_cast<std::size_t>(count++)] = static_cast<char>('0' + value % 10U);
    value /= 10U;
  } while (value != 0);
  for (int i = count; i < min_digits; ++i) {
    put('0');
  }
  while (count > 0) {
    put(digits[static_cast<std::size_t>(--count)]);
  }
}

TextWriter& TextWriter::integer(std::int64_t value) noexcept {
  auto magnitude = static_cast<std::uint64_t>(value);
  if (value < 0) {
    put('-');
    magnitude = 0U - magnitude;
  }
  unsigned_digits(magnitude, 1);
  return *this;
}

TextWriter& TextWriter::fixed(double value, int decimals) noexcept {
  if (std::isnan(value)) {
    return text("nan");
  }
  double magnitude = std::fabs(value);
  if (std::isinf(value)) {
    return text(value < 0 ? "-inf" : "inf");
  }
  decimals = std::clamp(decimals, 0, kMaxDecimals);
  int exponent = 0;
  while (magnitude >= kFixedLimit) {
    magnitude /= 10.0;
    ++exponent;
  }
  // The whole part and the rest are both exact, so one rounding remains: that of rest x 10^d.
  auto whole = static_cast<std::uint64_t>(magnitude);
  const std::uint64_t scale = power_of_ten(decimals);
  const double rest = magnitude - static_cast<double>(whole);
  auto fraction = static_cast<std::uint64_t>(rest * static_cast<double>(scale) + 0.5);
  if (fraction >= scale) {
    fraction -= scale;
    ++whole;
  }
  if (value < 0 && (whole != 0 || fraction != 0)) {
    put('-');
  }
  unsigned_digits(whole, 1);
  if (decimals > 0) {
    put('.');
    unsigned_digits(fraction, decimals);
  }
  if (exponent > 0) {
    put('e');
    unsigned_digits(static_cast<std::uint64_t>(exponent), 1);
  }
  return *this;
}

TextWriter& TextWriter::compact(double value, int max_decimals) noexcept {
  std::array<char, 48> storage{};
  TextWriter number(storage);
  number.fixed(value, max_decimals);
  std::string_view digits = number.view();
  if (digits.find('.') != std::string_view::npos && digits.find('e') == std::string_view::npos) {
    while (digits.back() == '0') {
      digits.remove_suffix(1);
    }
    if (digits.back() == '.') {
      digits.remove_suffix(1);
    }
  }
  return text(digits);
}

TextWriter& TextWriter::column(std::size_t column) noexcept {
  do {
    put(' ');
  } while (!truncated_ && size_ - line_start_ < column);
  return *this;
}

TextWriter& TextWriter::end_line() noexcept {
  text("\r\n");
  line_start_ = size_;
  return *this;
}

void TextWriter::clear() noexcept {
  size_ = 0;
  line_start_ = 0;
  truncated_ = false;
}

}  // namespace towbench::bbmc
