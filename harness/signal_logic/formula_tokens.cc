#include "harness/signal_logic/formula_tokens.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace towbench::harness {
namespace {

struct Unit {
  std::string_view name;
  std::string_view si;
  double factor;
};
constexpr std::array<Unit, 16> kUnits{{{"mm/s", "m/s", 1e-3},
                                       {"m/s", "m/s", 1},
                                       {"rad/s", "rad/s", 1},
                                       {"counts", "counts", 1},
                                       {"mm", "m", 1e-3},
                                       {"um", "m", 1e-6},
                                       {"ms", "s", 1e-3},
                                       {"us", "s", 1e-6},
                                       {"mA", "A", 1e-3},
                                       {"Nm", "Nm", 1},
                                       {"m", "m", 1},
                                       {"s", "s", 1},
                                       {"A", "A", 1},
                                       {"V", "V", 1},
                                       {"N", "N", 1},
                                       {"%", "%", 1}}};

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}

  tl::expected<std::vector<Token>, FormulaError> split() {
    std::vector<Token> tokens;
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      Token token;
      token.column = at_ + 1;
      const char c = text_[at_];
      if (is_letter(c)) {
        token.kind = Token::Kind::kWord;
        token.text = take_word();
      } else if (is_digit(c)) {
        if (!take_number(token)) {
          return tl::unexpected(
              FormulaError{token.column, std::string(text_.substr(at_, 12)), "a finite number"});
        }
      } else if (const auto length = sign_length(); length > 0) {
        token.kind = Token::Kind::kSign;
        token.text = text_.substr(at_, length);
        at_ += length;
      } else {
        return tl::unexpected(FormulaError{token.column, std::string(1, c),
                                           "words, numbers and < <= > >= = + - * | ( ) :"});
      }
      tokens.push_back(token);
    }
    tokens.push_back({.text = "the end", .column = text_.size() + 1});
    return tokens;
  }

 private:
  void skip_blanks() noexcept {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) {
      ++at_;
    }
  }

  std::string_view take_word() noexcept {
    const auto from = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) {
      ++at_;
    }
    return text_.substr(from, at_ - from);
  }

  bool take_number(Token& token) noexcept {
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), token.number);
    if (error != std::errc() || !std::isfinite(token.number)) {
      return false;
    }
    const auto from = at_;
    at_ += static_cast<std::size_t>(end - begin);
    token.kind = Token::Kind::kNumber;
    token.text = text_.substr(from, at_ - from);
    token.unit = "1";
    take_unit(token);
    return true;
  }

  void take_unit(Token& token) noexcept {
    const auto before = at_;
    skip_blanks();
    const auto rest = text_.substr(at_);
    for (const auto& unit : kUnits) {
      const auto length = unit.name.size();
      const bool ends = rest.size() <= length ||
                        !(is_letter(rest[length]) || is_digit(rest[length]) || rest[length] == '/');
      if (rest.starts_with(unit.name) && ends) {
        token.number *= unit.factor;
        token.unit = unit.si;
        at_ += length;
        return;
      }
    }
    at_ = before;
  }

  [[nodiscard]] std::size_t sign_length() const noexcept {
    const auto rest = text_.substr(at_);
    if (rest.starts_with("<=") || rest.starts_with(">=")) {
      return 2;
    }
    return std::string_view("<>=+-*|():").find(rest.front()) != std::string_view::npos ? 1 : 0;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

tl::expected<std::vector<Token>, FormulaError> tokens_of(std::string_view text) {
  return Splitter(text).split();
}

}  // namespace towbench::harness
