// Formulas as people write them:
//
//   always in steady: |y_error| < 1 mm
//   after kill_edge within 2 ms: |y_duty| = 0 until reset
//   always: y_speed > 0.3 m/s implies eventually within 1 s: |y_error| <= 20 um
//
// `not` binds closest, then `until`, `and`, `or`, `implies`; what follows a colon reaches as far as
// it can. Units are part of a number, both sides of a comparison must have the same.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "harness/signal_logic/formula.h"

namespace towbench::harness {

struct SignalName {
  std::string name;
  std::string unit;  // SI, "%" or "1"
};

struct Vocabulary {
  std::vector<SignalName> signals{};
  std::vector<std::string> events{};
  std::vector<std::string> windows{};
};

struct ParsedFormula {
  Formula formula{};
  // Of its margin: that of its comparisons when they all have the same, else "1": each distance
  // counts in units of the number that is compared with.
  std::string unit{};
};

struct FormulaError {
  std::size_t column = 0;  // 1-based
  std::string given{};
  std::string allowed{};
};

inline constexpr std::size_t kLongestFormula = 2000;  // characters
inline constexpr std::size_t kDeepestFormula = 40;    // parts within parts

[[nodiscard]] tl::expected<ParsedFormula, FormulaError> parse_formula(std::string_view text,
                                                                      const Vocabulary& vocabulary);

}  // namespace towbench::harness
