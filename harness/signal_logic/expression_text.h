// Sums of signals and numbers, with their unit.
#pragma once

#include <cstddef>
#include <string>

#include "harness/signal_logic/token_reader.h"

namespace towbench::harness {

struct Measured {
  Expression expression{};
  std::string unit{};
};

inline constexpr const char* kAnyUnit = "";  // of a zero without a unit

// Both throw FormulaError.
[[nodiscard]] Measured read_sum(TokenReader& reader, const Vocabulary& vocabulary);
// `column` is where the right one begins.
[[nodiscard]] std::string common_unit(const Measured& left, const Measured& right,
                                      std::size_t column);

}  // namespace towbench::harness
