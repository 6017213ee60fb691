#include "harness/signal_logic/expression_text.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::harness {
namespace {

std::string named_unit(const std::string& unit) {
  return unit == "1" ? "a quantity without a unit" : "a quantity in " + unit;
}

class ExpressionReader {
 public:
  ExpressionReader(TokenReader& reader, const Vocabulary& vocabulary)
      : reader_(reader), vocabulary_(vocabulary) {}

  Measured sum() {
    auto left = product();
    while (reader_.now().text == "+" || reader_.now().text == "-") {
      const bool adds = reader_.now().text == "+";
      reader_.step();
      const auto column = reader_.now().column;
      auto right = product();
      const auto unit = common_unit(left, right, column);
      Expression both{.kind = adds ? Expression::Kind::kSum : Expression::Kind::kDifference};
      both.parts.push_back(std::move(left.expression));
      both.parts.push_back(std::move(right.expression));
      left = {std::move(both), unit};
      reader_.require_shallow(++terms_);
    }
    return left;
  }

  Measured product() {
    if (reader_.now().kind == Token::Kind::kNumber && reader_.next().text == "*") {
      if (reader_.now().unit != "1") {
        reader_.refuse("a factor without a unit");
      }
      const double factor = reader_.now().number;
      reader_.step();
      reader_.step();
      auto what = operand();
      Expression scaled{.kind = Expression::Kind::kScaled, .number = factor};
      scaled.parts.push_back(std::move(what.expression));
      return {std::move(scaled), std::move(what.unit)};
    }
    return operand();
  }

  Measured operand() {
    const TokenReader::Deeper deeper(reader_);
    const auto token = reader_.now();
    if (reader_.take("-")) {
      auto what = product();
      if (what.expression.kind == Expression::Kind::kNumber) {
        what.expression.number = -what.expression.number;
        return what;
      }
      Expression negative{.kind = Expression::Kind::kScaled, .number = -1};
      negative.parts.push_back(std::move(what.expression));
      return {std::move(negative), std::move(what.unit)};
    }
    if (reader_.take("|")) {
      auto what = sum();
      reader_.need("|");
      Expression magnitude{.kind = Expression::Kind::kMagnitude};
      magnitude.parts.push_back(std::move(what.expression));
      return {std::move(magnitude), std::move(what.unit)};
    }
    if (token.kind == Token::Kind::kNumber) {
      reader_.step();
      const bool zero = token.number == 0 && token.unit == "1";
      return {{.kind = Expression::Kind::kNumber, .number = token.number},
              std::string(zero ? kAnyUnit : token.unit)};
    }
    return signal();
  }

  Measured signal() {
    const auto& known = vocabulary_.signals;
    const auto found = std::find_if(known.begin(), known.end(), [&](const SignalName& one) {
      return reader_.now().kind == Token::Kind::kWord && one.name == reader_.now().text;
    });
    if (found == known.end()) {
      std::vector<std::string> names;
      std::transform(known.begin(), known.end(), std::back_inserter(names),
                     [](const SignalName& one) { return one.name; });
      reader_.refuse(fmt::format("a signal: {}; an event: {}; or a number", fmt::join(names, " "),
                                 fmt::join(vocabulary_.events, " ")));
    }
    reader_.step();
    return {{.kind = Expression::Kind::kSignal,
             .signal = static_cast<std::size_t>(found - known.begin())},
            found->unit};
  }

 private:
  TokenReader& reader_;
  const Vocabulary& vocabulary_;
  std::size_t terms_ = 0;
};

}  // namespace

std::string common_unit(const Measured& left, const Measured& right, std::size_t column) {
  if (left.unit != right.unit && left.unit != kAnyUnit && right.unit != kAnyUnit) {
    throw FormulaError{column, named_unit(right.unit), named_unit(left.unit)};
  }
  return left.unit == kAnyUnit ? right.unit : left.unit;
}

Measured read_sum(TokenReader& reader, const Vocabulary& vocabulary) {
  return ExpressionReader(reader, vocabulary).sum();
}

}  // namespace towbench::harness
