// SI inside, convenient units for the reader: 0.00031 m is shown as 310 µm.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace towbench::harness::report {

struct DisplayUnit {
  std::string_view name;  // "mm"; empty for a bare number
  double per_si = 1;      // shown = SI value x per_si
};

// The unit in which the largest of `values_si` (non-finite ones aside) reads best.
[[nodiscard]] DisplayUnit display_unit(std::string_view unit_si, std::span<const double> values_si);

// Four significant digits, without trailing noise: "0.3100" -> "0.31", "12300" stays.
[[nodiscard]] std::string readable_number(double value);

// readable_number and unit, joined by a no-break space.
[[nodiscard]] std::string readable_quantity(double value_si, std::string_view unit_si);

}  // namespace towbench::harness::report
