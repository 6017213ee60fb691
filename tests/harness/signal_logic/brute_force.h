// Formulas drawn at random, as text and as what they mean by the definition: every sample within
// the bounds of every sample, without a shortcut. Shares no code with harness/signal_logic.
#pragma once

#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace towbench::tests {

struct PlainTrace {
  std::vector<double> time_s;
  std::vector<std::vector<double>> signals;  // a, b, c; NaN: none
  std::vector<double> event_s;               // "knock"
  std::vector<double> end_s;                 // "rest"
  double window_from_s = 0;                  // "middle"
  double window_to_s = 0;
};

class PlainFormula {
 public:
  virtual ~PlainFormula() = default;
  [[nodiscard]] virtual std::string text() const = 0;
  // At one sample; `truth`: +1 or -1 instead of a distance.
  [[nodiscard]] virtual double at(const PlainTrace& trace, std::size_t sample,
                                  bool truth) const = 0;
};

[[nodiscard]] PlainTrace drawn_trace(std::mt19937& random);
// `depth` parts within parts at most; its outermost part speaks of time.
[[nodiscard]] std::unique_ptr<PlainFormula> drawn_formula(std::mt19937& random, int depth);

}  // namespace towbench::tests
