#include "bbmc/application/console/decimal.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace towbench::bbmc {
namespace {

// 19 digits fit 64 bits whatever they are.
constexpr int kMaxDigits = 19;
constexpr int kMaxExponent = 300;
// 10^22 is the largest power of ten that a double holds exactly.
constexpr int kExactExponent = 22;

constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

constexpr double exact_power_of_ten(int exponent) noexcept {
  double power = 1.0;
  for (int i = 0; i < exponent; ++i) {
    power *= 10.0;
  }
  return power;
}

struct Scanner {
  std::string_view text;
  std::uint64_t mantissa = 0;
  int digits = 0;    // significant ones, leading zeros do not count
  int exponent = 0;  // of ten
  bool any_digit = false;

  [[nodiscard]] bool at_digit() const noexcept { return !text.empty() && is_digit(text.front()); }

  void take_digits(bool after_point) noexcept {
    for (; at_digit(); text.remove_prefix(1)) {
      any_digit = true;
      const auto digit = static_cast<std::uint64_t>(text.front() - '0');
      if (digits == kMaxDigits) {
        exponent = std::min(exponent + (after_point ? 0 : 1), 2 * kMaxExponent);
        continue;
      }
      mantissa = mantissa * 10U + digit;
      digits += mantissa != 0 ? 1 : 0;
      exponent = std::max(exponent - (after_point ? 1 : 0), -2 * kMaxExponent);
    }
  }

  void take_exponent() noexcept {
    std::string_view ahead = text;
    if (ahead.empty() || (ahead.front() != 'e' && ahead.front() != 'E')) {
      return;
    }
    ahead.remove_prefix(1);
    const bool negative = !ahead.empty() && ahead.front() == '-';
    if (!ahead.empty() && (ahead.front() == '-' || ahead.front() == '+')) {
      ahead.remove_prefix(1);
    }
    if (ahead.empty() || !is_digit(ahead.front())) {
      return;
    }
    int value = 0;
    for (; !ahead.empty() && is_digit(ahead.front()); ahead.remove_prefix(1)) {
      value = std::min(value * 10 + (ahead.front() - '0'), 2 * kMaxExponent);
    }
    exponent += negative ? -value : value;
    text = ahead;
  }
};

// One exact operation where possible (Clinger 1990, "How to read floating point numbers
// accurately"): mantissa and power are then both exact, so the result is correctly rounded.
double scaled(std::uint64_t mantissa, int exponent) noexcept {
  auto value = static_cast<double>(mantissa);
  for (; exponent > 0; exponent -= std::min(exponent, kExactExponent)) {
    value *= exact_power_of_ten(std::min(exponent, kExactExponent));
  }
  for (; exponent < 0; exponent += std::min(-exponent, kExactExponent)) {
    value /= exact_power_of_ten(std::min(-exponent, kExactExponent));
  }
  return value;
}

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view text) noexcept {
  Scanner scanner{.text = text};
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    scanner.text.remove_prefix(1);
  }
  scanner.take_digits(false);
  if (!scanner.text.empty() && scanner.text.front() == '.') {
    scanner.text.remove_prefix(1);
    scanner.take_digits(true);
  }
  if (!scanner.any_digit) {
    return std::nullopt;
  }
  scanner.take_exponent();
  const int magnitude_exponent = scanner.mantissa == 0 ? 0 : scanner.digits + scanner.exponent;
  if (magnitude_exponent > kMaxExponent) {
    return std::nullopt;
  }
  // Zeros at the end of a fraction would cost exactness for nothing: 0.5000000000000000000.
  while (scanner.mantissa != 0 && scanner.mantissa % 10U == 0 && scanner.exponent < 0) {
    scanner.mantissa /= 10U;
    ++scanner.exponent;
  }
  const double magnitude =
      magnitude_exponent < -kMaxExponent ? 0.0 : scaled(scanner.mantissa, scanner.exponent);
  return Decimal{.value = negative ? -magnitude : magnitude, .rest = scanner.text};
}

std::optional<std::int64_t> parse_integer(std::string_view text) noexcept {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') {
      return std::nullopt;
    }
  }
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || text.empty()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace towbench::bbmc
