#include "harness/signal_logic/robustness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "harness/signal_logic/time_ranges.h"

namespace towbench::harness {
namespace {

using Values = std::vector<double>;
using Kind = Formula::Kind;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

void negate(Values& values) {
  std::transform(values.begin(), values.end(), values.begin(), std::negate<>());
}

Values numbers_of(const Expression& expression, const Trace& trace) {
  switch (expression.kind) {
    case Expression::Kind::kNumber:
      return Values(trace.samples(), expression.number);
    case Expression::Kind::kSignal: {
      const auto& signal = trace.signals.at(expression.signal);
      return signal.empty() ? Values(trace.samples(), kNone) : signal;
    }
    default:
      break;
  }
  auto left = numbers_of(expression.parts.front(), trace);
  if (expression.kind == Expression::Kind::kScaled) {
    for (auto& value : left) {
      value *= expression.number;
    }
    return left;
  }
  if (expression.kind == Expression::Kind::kMagnitude) {
    for (auto& value : left) {
      value = std::fabs(value);
    }
    return left;
  }
  const auto right = numbers_of(expression.parts.back(), trace);
  const double sign = expression.kind == Expression::Kind::kSum ? 1 : -1;
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] += sign * right[i];
  }
  return left;
}

double distance(Comparison comparison, double left, double right) {
  switch (comparison) {
    case Comparison::kLess:
    case Comparison::kAtMost:
      return right - left;
    case Comparison::kMore:
    case Comparison::kAtLeast:
      return left - right;
    case Comparison::kEqual:
      break;
  }
  return 0 - std::fabs(left - right);  // 0, not -0
}

double truth(Comparison comparison, double left, double right) {
  if (std::isnan(left) || std::isnan(right)) {
    return kNone;
  }
  const bool strict = comparison == Comparison::kLess || comparison == Comparison::kMore;
  const double margin = distance(comparison, left, right);
  return margin > 0 || (margin == 0 && !strict) ? 1 : -1;
}

Values compared(const Formula& formula, const Trace& trace, Reading reading) {
  auto left = numbers_of(formula.sides.front(), trace);
  const auto right = numbers_of(formula.sides.back(), trace);
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = reading == Reading::kTruth
                  ? truth(formula.comparison, left[i], right[i])
                  : distance(formula.comparison, left[i], right[i]) / formula.scale;
  }
  return left;
}

Values marked(const Formula& formula, const Trace& trace, Reading reading) {
  const double size = reading == Reading::kTruth ? 1 : kUnbounded;
  Values values(trace.samples(), -size);
  const auto found = trace.events.find(formula.event);
  if (found != trace.events.end()) {
    for (const double event_s : found->second) {
      const auto at =
          std::lower_bound(trace.time_s.begin(), trace.time_s.end(), event_s - kSameTime_s);
      if (at != trace.time_s.end()) {
        values[static_cast<std::size_t>(at - trace.time_s.begin())] = size;
      }
    }
  }
  return values;
}

double smallest_in(const Values& values, const SampleRange& range) {
  double smallest = kNone;
  for (std::size_t i = range.first; i < range.end; ++i) {
    smallest = std::fmin(smallest, values[i]);
  }
  return smallest;
}

Values always(const Formula& formula, const Values& part, const Trace& trace) {
  if (formula.window.empty()) {
    return sliding_minimum(part, ranges_of(formula.bounds, trace));
  }
  const auto window = trace.windows.find(formula.window);
  const bool known = window != trace.windows.end();
  return Values(trace.samples(),
                known ? smallest_in(part, range_of(window->second, trace)) : kNone);
}

Values eventually(const Formula& formula, Values part, const Trace& trace) {
  negate(part);
  part = always(formula, part, trace);
  negate(part);
  return part;
}

// With bounds [a, b] it is: the second part within [a, b], the first before a, and the unbounded
// until from a on (Donze, Ferrere, Maler, Efficient robust monitoring for STL, CAV 2013, lemma 3).
Values until(const Formula& formula, Values first, Values second, const Trace& trace) {
  const auto count = trace.samples();
  for (std::size_t i = 0; i < count; ++i) {
    first[i] = std::isnan(first[i]) ? kUnbounded : first[i];
    second[i] = std::isnan(second[i]) ? -kUnbounded : second[i];
  }
  Values unbounded(count);
  double behind = -kUnbounded;
  for (std::size_t i = count; i-- > 0;) {
    behind = std::fmax(second[i], std::fmin(first[i], behind));
    unbounded[i] = behind;
  }
  const auto ranges = ranges_of(formula.bounds, trace);
  std::vector<SampleRange> before(count);
  for (std::size_t i = 0; i < count; ++i) {
    before[i] = {i, std::max(i, ranges[i].first)};
  }
  const auto held = sliding_minimum(first, before);
  negate(second);
  auto within = sliding_minimum(second, ranges);
  negate(within);
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isnan(within[i])) {
      within[i] = std::fmin(std::fmin(within[i], held[i]), unbounded[ranges[i].first]);
    }
  }
  return within;
}

// The part where it is demanded, nothing elsewhere.
Values demanded(const Formula& formula, const Values& part, const Trace& trace) {
  Values values(trace.samples(), kNone);
  for (const auto& range : obligations_of(formula, trace)) {
    std::copy(part.begin() + static_cast<std::ptrdiff_t>(range.first),
              part.begin() + static_cast<std::ptrdiff_t>(range.end),
              values.begin() + static_cast<std::ptrdiff_t>(range.first));
  }
  return values;
}

Values joined(Kind kind, Values left, const Values& right) {
  if (kind == Kind::kImplies) {
    negate(left);
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    left[i] = kind == Kind::kAnd ? std::fmin(left[i], right[i]) : std::fmax(left[i], right[i]);
  }
  return left;
}

// What the outermost operators in time range over.
Values over_time(const Formula& formula, const Trace& trace) {
  const auto inner = [&](std::size_t i) {
    return evaluate(formula.parts[i], trace, Reading::kMargin);
  };
  switch (formula.kind) {
    case Kind::kAlways:
    case Kind::kEventually: {
      Values values = inner(0);
      SampleRange range{0, trace.samples()};
      if (const auto window = trace.windows.find(formula.window); window != trace.windows.end()) {
        range = range_of(window->second, trace);
      } else if (const auto ranges = ranges_of(formula.bounds, trace); !ranges.empty()) {
        range = ranges.front();
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = i < range.first || i >= range.end ? kNone : values[i];
      }
      return values;
    }
    case Kind::kAfter:
      return demanded(formula, inner(0), trace);
    case Kind::kAnd: {
      return joined(Kind::kAnd, over_time(formula.parts[0], trace),
                    over_time(formula.parts[1], trace));
    }
    default:
      return evaluate(formula, trace, Reading::kMargin);
  }
}

}  // namespace

Values evaluate(const Formula& formula, const Trace& trace, Reading reading) {
  const auto part = [&](std::size_t i) { return evaluate(formula.parts[i], trace, reading); };
  switch (formula.kind) {
    case Kind::kCompare:
      return compared(formula, trace, reading);
    case Kind::kEvent:
      return marked(formula, trace, reading);
    case Kind::kNot: {
      auto values = part(0);
      negate(values);
      return values;
    }
    case Kind::kAlways:
      return always(formula, part(0), trace);
    case Kind::kEventually:
      return eventually(formula, part(0), trace);
    case Kind::kUntil:
      return until(formula, part(0), part(1), trace);
    case Kind::kAfter:
      return Values(trace.samples(),
                    smallest_in(demanded(formula, part(0), trace), {0, trace.samples()}));
    default:
      return joined(formula.kind, part(0), part(1));
  }
}

Robustness robustness_of(const Formula& formula, const Trace& trace) {
  Robustness found;
  if (trace.samples() == 0) {
    return found;
  }
  found.over_time = over_time(formula, trace);
  const double margin = evaluate(formula, trace, Reading::kMargin).front();
  if (!std::isfinite(margin)) {
    return found;
  }
  found.margin = margin;
  found.holds = evaluate(formula, trace, Reading::kTruth).front() > 0;
  const auto worst = std::find(found.over_time.begin(), found.over_time.end(), margin);
  if (worst != found.over_time.end()) {
    found.worst_s = trace.time_s[static_cast<std::size_t>(worst - found.over_time.begin())];
  }
  return found;
}

}  // namespace towbench::harness
