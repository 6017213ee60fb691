// Steps through the tokens of a formula; the first thing that cannot be is thrown as FormulaError.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/signal_logic/formula_tokens.h"

namespace towbench::harness {

class TokenReader {
 public:
  explicit TokenReader(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  [[nodiscard]] const Token& now() const noexcept { return tokens_[at_]; }
  // The end follows itself.
  [[nodiscard]] const Token& next() const noexcept {
    return tokens_[at_ + 1 < tokens_.size() ? at_ + 1 : at_];
  }
  void step() noexcept { at_ += at_ + 1 < tokens_.size() ? 1U : 0U; }
  bool take(std::string_view text) {
    const bool is = now().kind != Token::Kind::kEnd && now().text == text;
    at_ += is ? 1U : 0U;
    return is;
  }
  void need(std::string_view text) {
    if (!take(text)) {
      refuse(std::string(text));
    }
  }
  [[noreturn]] void refuse(std::string allowed) const {
    throw FormulaError{now().column, '"' + std::string(now().text) + '"', std::move(allowed)};
  }
  void require_shallow(std::size_t depth) const {
    if (depth > kDeepestFormula) {
      throw FormulaError{now().column, "parts within parts, or terms of sums",
                         fmt::format("at most {}", kDeepestFormula)};
    }
  }

  class Deeper {
   public:
    explicit Deeper(TokenReader& reader) : reader_(reader) {
      reader.require_shallow(reader.depth_ + 1);
      ++reader.depth_;
    }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    ~Deeper() { --reader_.depth_; }

   private:
    TokenReader& reader_;
  };

 private:
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace towbench::harness
