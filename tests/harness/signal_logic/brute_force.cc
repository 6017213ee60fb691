#include "tests/harness/signal_logic/brute_force.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace towbench::tests {
namespace {

using Part = std::unique_ptr<PlainFormula>;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSlack_s = 0.4e-9;

int drawn(std::mt19937& random, int from, int to) {
  return std::uniform_int_distribution<int>(from, to)(random);
}

double lesser(double a, double b) {
  return std::isnan(a) ? b : std::isnan(b) ? a : a < b ? a : b;
}
double greater(double a, double b) {
  return -lesser(-a, -b);
}

class Comparison final : public PlainFormula {
 public:
  explicit Comparison(std::mt19937& random)
      : signal_(drawn(random, 0, 2)),
        sign_(drawn(random, 0, 4)),
        shape_(drawn(random, 0, 3)),
        limit_(drawn(random, -4, 4)) {}
  [[nodiscard]] std::string text() const override {
    static const char* const kSigns[] = {"<", "<=", ">", ">=", "="};
    const char name = static_cast<char>('a' + signal_);
    const std::string left[] = {std::string(1, name), fmt::format("|{}|", name),
                                fmt::format("{} - b", name), fmt::format("2 * {} + c", name)};
    return fmt::format("{} {} {}", left[shape_], kSigns[sign_], limit_);
  }
  [[nodiscard]] double at(const PlainTrace& trace, std::size_t i, bool truth) const override {
    const double x = trace.signals[static_cast<std::size_t>(signal_)][i];
    const double left = shape_ == 0   ? x
                        : shape_ == 1 ? std::fabs(x)
                        : shape_ == 2 ? x - trace.signals[1][i]
                                      : 2 * x + trace.signals[2][i];
    if (std::isnan(left)) {
      return kNone;
    }
    const bool holds[] = {left<limit_, left <= limit_, left> limit_, left >= limit_,
                          left == limit_};
    const double by = sign_ < 2   ? limit_ - left
                      : sign_ < 4 ? left - limit_
                                  : -std::fabs(left - limit_);
    return truth ? (holds[sign_] ? 1 : -1) : by;
  }

 private:
  int signal_;
  int sign_;
  int shape_;
  int limit_;
};

class Knock final : public PlainFormula {
 public:
  [[nodiscard]] std::string text() const override { return "knock"; }
  [[nodiscard]] double at(const PlainTrace& trace, std::size_t i, bool truth) const override {
    for (const double event_s : trace.event_s) {
      const bool not_before = trace.time_s[i] >= event_s - kSlack_s;
      const bool first = i == 0 || trace.time_s[i - 1] < event_s - kSlack_s;
      if (not_before && first) {
        return truth ? 1 : kInfinite;
      }
    }
    return truth ? -1 : -kInfinite;
  }
};

class Joined final : public PlainFormula {
 public:
  Joined(int kind, Part left, Part right)
      : kind_(kind), left_(std::move(left)), right_(std::move(right)) {}
  [[nodiscard]] std::string text() const override {
    static const char* const kWords[] = {"and", "or", "implies"};
    return kind_ == 3 ? fmt::format("(not {})", left_->text())
                      : fmt::format("({} {} {})", left_->text(), kWords[kind_], right_->text());
  }
  [[nodiscard]] double at(const PlainTrace& trace, std::size_t i, bool truth) const override {
    const double left = left_->at(trace, i, truth);
    const double right = right_->at(trace, i, truth);
    return kind_ == 0   ? lesser(left, right)
           : kind_ == 1 ? greater(left, right)
           : kind_ == 2 ? greater(-left, right)
                        : -left;
  }

 private:
  int kind_;
  Part left_;
  Part right_;
};

class Ranging final : public PlainFormula {
 public:
  Ranging(std::mt19937& random, int kind, Part part, Part other)
      : kind_(kind), scope_(drawn(random, 0, 3)), part_(std::move(part)), other_(std::move(other)) {
    from_ms_ = drawn(random, 0, 20);
    to_ms_ = from_ms_ + drawn(random, 0, 30);
    scope_ = kind_ == 2 && scope_ == 3 ? 2 : scope_;
  }
  [[nodiscard]] std::string text() const override {
    const std::string scope = scope_ == 0   ? ""
                              : scope_ == 1 ? fmt::format("within {} ms ", to_ms_)
                              : scope_ == 2 ? fmt::format("from {} ms to {} ms ", from_ms_, to_ms_)
                                            : "in middle ";
    return kind_ == 2 ? fmt::format("({} until {} {})", part_->text(), scope, other_->text())
                      : fmt::format("({} {}: {})", kind_ == 0 ? "always" : "eventually", scope,
                                    part_->text());
  }
  [[nodiscard]] double at(const PlainTrace& trace, std::size_t i, bool truth) const override {
    double found = kNone;
    double before = kInfinite;  // of until: the first part from i up to the sample before
    for (std::size_t j = 0; j < trace.time_s.size(); ++j) {
      if (in_scope(trace, i, j)) {
        const double value =
            kind_ == 2 ? witnessed(trace, j, truth, before) : part_->at(trace, j, truth);
        found = kind_ == 0 ? lesser(found, value) : greater(found, value);
      }
      before = kind_ == 2 && j >= i ? lesser(before, part_->at(trace, j, truth)) : before;
    }
    return found;
  }

 private:
  [[nodiscard]] bool in_scope(const PlainTrace& trace, std::size_t i, std::size_t j) const {
    const double t = trace.time_s[j];
    if (scope_ == 3) {
      return t >= trace.window_from_s - kSlack_s && t <= trace.window_to_s + kSlack_s;
    }
    const double after_s = t - trace.time_s[i];
    const double from_s = scope_ == 2 ? from_ms_ * 1e-3 : 0;
    const double to_s = scope_ == 0 ? kInfinite : to_ms_ * 1e-3;
    return after_s >= from_s - kSlack_s && after_s <= to_s + kSlack_s;
  }
  [[nodiscard]] double witnessed(const PlainTrace& trace, std::size_t j, bool truth,
                                 double before) const {
    const double value = other_->at(trace, j, truth);
    return std::isnan(value) ? -kInfinite : lesser(value, before);
  }

  int kind_;  // always, eventually, until
  int scope_;
  int from_ms_ = 0;
  int to_ms_ = 0;
  Part part_;
  Part other_;
};

class After final : public PlainFormula {
 public:
  After(std::mt19937& random, Part part)
      : within_ms_(drawn(random, 0, 15)), ends_(drawn(random, 0, 1) == 1), part_(std::move(part)) {}
  [[nodiscard]] std::string text() const override {
    return fmt::format("(after knock within {} ms: {}{})", within_ms_, part_->text(),
                       ends_ ? " until rest" : "");
  }
  [[nodiscard]] double at(const PlainTrace& trace, std::size_t /*i*/, bool truth) const override {
    double found = kNone;
    for (const double event_s : trace.event_s) {
      const double due_s = event_s + within_ms_ * 1e-3;
      const double free_s = end_behind(trace, event_s);
      for (std::size_t j = 0; j < trace.time_s.size(); ++j) {
        // A sample counts from its time to the next one's.
        const bool is_last = j + 1 == trace.time_s.size();
        const bool reaches =
            is_last ? trace.time_s[j] >= due_s - kSlack_s : trace.time_s[j + 1] > due_s + kSlack_s;
        const bool demanded = reaches && free_s > due_s && trace.time_s[j] < free_s - kSlack_s;
        found = demanded ? lesser(found, part_->at(trace, j, truth)) : found;
      }
    }
    return found;
  }

 private:
  [[nodiscard]] double end_behind(const PlainTrace& trace, double event_s) const {
    double first_s = kInfinite;
    for (const double end_s : trace.end_s) {
      first_s = ends_ && end_s > event_s && end_s < first_s ? end_s : first_s;
    }
    return first_s;
  }

  int within_ms_;
  bool ends_;
  Part part_;
};

Part part_of(std::mt19937& random, int depth) {
  const int kind = depth <= 0 ? drawn(random, 0, 5) : drawn(random, 0, 13);
  if (kind == 5) {
    return std::make_unique<Knock>();
  }
  if (kind < 5) {
    return std::make_unique<Comparison>(random);
  }
  if (kind < 10) {
    auto left = part_of(random, depth - 1);
    return std::make_unique<Joined>(kind - 6, std::move(left), part_of(random, depth - 1));
  }
  return drawn_formula(random, depth);
}

}  // namespace

PlainTrace drawn_trace(std::mt19937& random) {
  PlainTrace trace;
  const int samples = drawn(random, 1, 40);
  int time_ms = drawn(random, 0, 5);
  for (int i = 0; i < samples; ++i) {
    trace.time_s.push_back(time_ms * 1e-3);
    time_ms += drawn(random, 1, 6);
  }
  const int gap = drawn(random, 0, 6);  // 0: signals always have values
  for (int s = 0; s < 3; ++s) {
    std::vector<double> values;
    for (int i = 0; i < samples; ++i) {
      values.push_back(gap > 0 && drawn(random, 0, 6) < gap / 2 ? kNone : drawn(random, -5, 5));
    }
    trace.signals.push_back(std::move(values));
  }
  for (int ms = 0; ms < time_ms; ++ms) {
    const int chance = drawn(random, 0, 39);
    if (chance < 2) {
      trace.event_s.push_back(ms * 1e-3 + chance * 0.5e-3);
    } else if (chance < 4) {
      trace.end_s.push_back(ms * 1e-3 + (chance - 2) * 0.25e-3);
    }
  }
  trace.window_from_s = drawn(random, 0, 40) * 1e-3;
  trace.window_to_s = trace.window_from_s + drawn(random, 0, 60) * 1e-3;
  return trace;
}

std::unique_ptr<PlainFormula> drawn_formula(std::mt19937& random, int depth) {
  auto part = part_of(random, depth - 1);
  const int kind = drawn(random, 0, 3);
  if (kind == 3) {
    return std::make_unique<After>(random, std::move(part));
  }
  auto other = part_of(random, depth - 1);
  return std::make_unique<Ranging>(random, kind, std::move(part), std::move(other));
}

}  // namespace towbench::tests
