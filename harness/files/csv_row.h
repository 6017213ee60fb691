// A row of a CSV file: its cells, and the number in a cell.
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace towbench::harness {

// What stands for a number that is not there.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Cuts `line` at each separator into `cells`, each without the signs of `padding` at its ends. The
// views live as long as the line.
void split_csv_row(std::string_view line, char separator, std::string_view padding,
                   std::vector<std::string_view>& cells);

// A decimal point, with or without an exponent, or nan or inf; nothing else may stand beside it.
[[nodiscard]] std::optional<double> csv_number(std::string_view cell) noexcept;

}  // namespace towbench::harness
