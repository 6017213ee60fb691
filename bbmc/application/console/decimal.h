// A decimal number at the start of a text, without the C library (locale, errno and, on bare
// metal, its size).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace towbench::bbmc {

struct Decimal {
  double value = 0;
  std::string_view rest;  // what follows the number: a unit, or nothing
};

// [+-] digits [. digits] [e [+-] digits], at least one digit. Correctly rounded for at most 15
// significant digits and a decimal exponent within +-22; otherwise within 2 units in the last
// place. Nothing for text that does not start so, and for magnitudes of 1e300 and above.
// An 'e' without a digit behind it belongs to the rest.
[[nodiscard]] std::optional<Decimal> parse_decimal(std::string_view text) noexcept;

// All of the text, decimal digits with an optional sign; nothing on overflow.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text) noexcept;

}  // namespace towbench::bbmc
