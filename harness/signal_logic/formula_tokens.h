// The words, numbers and signs of a formula.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "harness/signal_logic/formula_text.h"

namespace towbench::harness {

struct Token {
  enum class Kind : std::uint8_t { kWord, kNumber, kSign, kEnd };
  Kind kind = Kind::kEnd;
  std::string_view text{};
  double number = 0;        // SI
  std::string_view unit{};  // SI; "1": it has none
  std::size_t column = 1;
};

// The last one is kEnd.
[[nodiscard]] tl::expected<std::vector<Token>, FormulaError> tokens_of(std::string_view text);

}  // namespace towbench::harness
