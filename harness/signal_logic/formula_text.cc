#include "harness/signal_logic/formula_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/signal_logic/expression_text.h"
#include "harness/signal_logic/token_reader.h"

namespace towbench::harness {
namespace {

// Recursive descent.
class Parser : private TokenReader {
 public:
  Parser(std::vector<Token> tokens, const Vocabulary& vocabulary)
      : TokenReader(std::move(tokens)), vocabulary_(vocabulary) {}

  ParsedFormula parse() {
    auto formula = implication();
    if (now().kind != Token::Kind::kEnd) {
      refuse("and, or, implies, until or the end");
    }
    if (!speaks_of_time(formula)) {
      throw FormulaError{1, "a condition without a time",
                         "always:, eventually: or after EVENT: before it"};
    }
    const bool one_unit =
        std::adjacent_find(units_.begin(), units_.end(), std::not_equal_to<>()) == units_.end();
    ParsedFormula parsed{std::move(formula), one_unit && !units_.empty() ? units_.front() : "1"};
    if (one_unit) {
      in_si(parsed.formula);
    }
    return parsed;
  }

 private:
  using Kind = Formula::Kind;

  // Everything but bare conditions has a time to which it belongs.
  static bool speaks_of_time(const Formula& formula) {
    switch (formula.kind) {
      case Kind::kCompare:
      case Kind::kEvent:
        return false;
      case Kind::kNot:
      case Kind::kAnd:
      case Kind::kOr:
      case Kind::kImplies:
        return std::all_of(formula.parts.begin(), formula.parts.end(), speaks_of_time);
      default:
        return true;
    }
  }

  static void in_si(Formula& formula) {
    formula.scale = 1;
    std::for_each(formula.parts.begin(), formula.parts.end(), in_si);
  }

  Formula implication() {
    const Deeper deeper(*this);
    auto left = disjunction();
    return take("implies") ? joined(Kind::kImplies, std::move(left), implication()) : left;
  }

  Formula disjunction() {
    auto left = conjunction();
    while (take("or")) {
      left = joined(Kind::kOr, std::move(left), conjunction());
    }
    return left;
  }

  Formula conjunction() {
    auto left = until();
    while (take("and")) {
      left = joined(Kind::kAnd, std::move(left), until());
    }
    return left;
  }

  Formula until() {
    auto left = unary();
    if (until_is_events_ || !take("until")) {
      return left;
    }
    const auto bounds = bounds_of_time();
    auto both = joined(Kind::kUntil, std::move(left), unary());
    both.bounds = bounds;
    return both;
  }

  Formula unary() {
    const Deeper deeper(*this);
    if (take("not")) {
      Formula formula{.kind = Kind::kNot};
      formula.parts.push_back(unary());
      return formula;
    }
    if (take("always")) {
      return scoped(Kind::kAlways);
    }
    if (take("eventually")) {
      return scoped(Kind::kEventually);
    }
    if (take("after")) {
      return after();
    }
    if (take("(")) {
      const bool outer = std::exchange(until_is_events_, false);
      auto formula = implication();
      until_is_events_ = outer;
      need(")");
      return formula;
    }
    return condition();
  }

  Formula scoped(Kind kind) {
    Formula formula{.kind = kind};
    if (take("in")) {
      formula.window = name_of(vocabulary_.windows, "the name of a window: ");
    } else {
      formula.bounds = bounds_of_time();
    }
    need(":");
    formula.parts.push_back(implication());
    return formula;
  }

  Formula after() {
    Formula formula{.kind = Kind::kAfter, .bounds = {0, 0}};
    formula.event = name_of(vocabulary_.events, "an event: ");
    if (take("within")) {
      formula.bounds.to_s = time();
    }
    need(":");
    const bool outer = std::exchange(until_is_events_, true);
    formula.parts.push_back(disjunction());
    until_is_events_ = outer;
    if (take("until")) {
      formula.until = name_of(vocabulary_.events, "an event: ");
    }
    return formula;
  }

  TimeBounds bounds_of_time() {
    TimeBounds bounds;
    if (take("within")) {
      bounds.to_s = time();
    } else if (take("from")) {
      bounds.from_s = time();
      need("to");
      const auto column = now().column;
      bounds.to_s = time();
      if (bounds.to_s < bounds.from_s) {
        throw FormulaError{column, "an empty interval", "a time not before the first"};
      }
    }
    return bounds;
  }

  double time() {
    const auto& token = now();
    const bool is_time =
        token.kind == Token::Kind::kNumber && (token.unit == "s" || token.number == 0);
    if (!is_time) {
      refuse("a time such as 2 ms");
    }
    const double number = token.number;
    step();
    return number;
  }

  Formula condition() {
    if (now().kind == Token::Kind::kWord && is_event(now().text)) {
      Formula formula{.kind = Kind::kEvent};
      formula.event = std::string(now().text);
      step();
      return formula;
    }
    auto left = read_sum(*this, vocabulary_);
    Formula formula{.kind = Kind::kCompare};
    formula.comparison = comparison();
    const auto column = now().column;
    auto right = read_sum(*this, vocabulary_);
    const auto unit = common_unit(left, right, column);
    units_.push_back(unit == kAnyUnit ? "1" : unit);
    formula.scale = scale_of(left.expression, right.expression);
    formula.sides.push_back(std::move(left.expression));
    formula.sides.push_back(std::move(right.expression));
    return formula;
  }

  static double scale_of(const Expression& left, const Expression& right) {
    for (const auto* side : {&right, &left}) {
      if (side->kind == Expression::Kind::kNumber && side->number != 0) {
        return std::fabs(side->number);
      }
    }
    return 1;
  }

  Comparison comparison() {
    constexpr std::array<std::pair<std::string_view, Comparison>, 5> kSigns{
        {{"<", Comparison::kLess},
         {"<=", Comparison::kAtMost},
         {">", Comparison::kMore},
         {">=", Comparison::kAtLeast},
         {"=", Comparison::kEqual}}};
    for (const auto& [sign, meant] : kSigns) {
      if (take(sign)) {
        return meant;
      }
    }
    refuse("< <= > >= or =");
  }

  [[nodiscard]] bool is_event(std::string_view word) const {
    return std::find(vocabulary_.events.begin(), vocabulary_.events.end(), word) !=
           vocabulary_.events.end();
  }

  std::string name_of(const std::vector<std::string>& names, const char* what) {
    if (std::find(names.begin(), names.end(), now().text) == names.end()) {
      refuse(what + fmt::format("{}", fmt::join(names, " ")));
    }
    std::string name(now().text);
    step();
    return name;
  }

  static Formula joined(Kind kind, Formula left, Formula right) {
    Formula both{.kind = kind};
    both.parts.push_back(std::move(left));
    both.parts.push_back(std::move(right));
    return both;
  }

  const Vocabulary& vocabulary_;
  bool until_is_events_ = false;  // inside `after`
  std::vector<std::string> units_;
};

}  // namespace

tl::expected<ParsedFormula, FormulaError> parse_formula(std::string_view text,
                                                        const Vocabulary& vocabulary) {
  if (text.size() > kLongestFormula) {
    return tl::unexpected(FormulaError{kLongestFormula + 1, "a longer formula",
                                       fmt::format("at most {} characters", kLongestFormula)});
  }
  auto tokens = tokens_of(text);
  if (!tokens) {
    return tl::unexpected(std::move(tokens.error()));
  }
  try {
    return Parser(std::move(*tokens), vocabulary).parse();
  } catch (FormulaError& error) {
    return tl::unexpected(std::move(error));
  }
}

}  // namespace towbench::harness
