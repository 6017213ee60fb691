#include "study/diagnose/column_guess.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {
namespace {

using Column = std::vector<double>;

constexpr double kAlike = 0.95;              // correlation of what shows the same thing
constexpr std::ptrdiff_t kLongestLag = 200;  // samples
constexpr std::size_t kMostLooked = 20000;   // rows: more say no more

constexpr std::array<std::string_view, 22> kUnits{
    "m_per_s2", "rad_per_s2", "m_per_s", "mm_per_s", "rad_per_s", "deg_per_s", "rpm",   "mrad",
    "rad",      "deg",        "um",      "mm",       "m",         "counts",    "count", "Nm",
    "N",        "pct",        "V",       "A",        "ms",        "s"};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// Behind the last "_" that begins one.
std::string unit_of(const std::string& name) {
  for (const auto unit : {"us", "ns"}) {
    if (name.ends_with(std::string("_") + unit)) return unit;
  }
  for (const auto unit : kUnits) {
    if (name.size() > unit.size() + 1 && name.ends_with(unit) &&
        name[name.size() - unit.size() - 1] == '_') {
      return std::string(unit);
    }
  }
  return {};
}

// Whether a part of the name, between "_", blanks, dots or digits, is one of the words.
bool says(const std::string& name, std::initializer_list<std::string_view> words) {
  std::string part;
  for (const char c : lower(name) + "_") {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      part += c;
      continue;
    }
    if (std::find(words.begin(), words.end(), part) != words.end()) return true;
    part.clear();
  }
  return false;
}

bool is_one_of(const std::string& unit, std::initializer_list<std::string_view> units) {
  return std::find(units.begin(), units.end(), unit) != units.end();
}

double correlation(const Column& a, const Column& b) {
  const auto n = static_cast<double>(a.size());
  double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

// How much of a column is new from sample to sample: a motion has little, a command much.
double roughness(const Column& c) {
  double mean = 0, about = 0, steps = 0;
  for (const double x : c) mean += x / static_cast<double>(c.size());
  for (std::size_t i = 1; i < c.size(); ++i) {
    about += (c[i] - mean) * (c[i] - mean);
    steps += (c[i] - c[i - 1]) * (c[i] - c[i - 1]);
  }
  return about > 0 ? std::sqrt(steps / about) : 1;
}

// Over `reach` samples either side, beside `of` without its ends.
Column slope(const Column& c, std::size_t reach) {
  Column out(c.size(), 0);
  for (std::size_t i = reach; i + reach < c.size(); ++i) out[i] = c[i + reach] - c[i - reach];
  return out;
}

// Without its mean, and of unit size: columns may be in different units.
Column standard(Column c) {
  double mean = 0;
  double square = 0;
  for (const double x : c) mean += x / static_cast<double>(c.size());
  for (double& x : c) {
    x -= mean;
    square += x * x / static_cast<double>(c.size());
  }
  for (double& x : c) x /= std::sqrt(std::max(1e-300, square));
  return c;
}

// Samples by which the second follows the first, where they are most alike; negative: the other
// way.
std::ptrdiff_t lag(const Column& first, const Column& second) {
  const Column early = standard(first);
  const Column late = standard(second);
  const auto n = std::ssize(early);
  const auto most = std::min<std::ptrdiff_t>(kLongestLag, n / 4);
  std::ptrdiff_t best = 0;
  double least = -1;
  for (std::ptrdiff_t by = -most; by <= most; ++by) {
    double sum = 0;
    for (std::ptrdiff_t i = most; i < n - most; ++i) {
      const double off =
          late[static_cast<std::size_t>(i)] - early[static_cast<std::size_t>(i - by)];
      sum += off * off;
    }
    if (least < 0 || sum < least) {
      least = sum;
      best = by;
    }
  }
  return best;
}

class Guesser {
 public:
  explicit Guesser(const logs::Table& table) {
    for (const auto& name : table.names) guesses_.push_back({.name = name, .unit = unit_of(name)});
    for (const auto& column : table.columns) columns_.push_back(looked_at(column));
    for (std::size_t i = 0; i < guesses_.size(); ++i) range(guesses_[i], table.columns[i]);
  }

  std::vector<ColumnGuess> guess() {
    find_time();
    find_position();
    find_velocities();
    find_reference();
    find_others();
    find_temperature();
    find_input();
    return std::move(guesses_);
  }

 private:
  // Without cells that are no number: the last one stands for them.
  static Column looked_at(const Column& column) {
    Column out;
    for (std::size_t i = 0; i < std::min(column.size(), kMostLooked); ++i) {
      out.push_back(std::isfinite(column[i]) ? column[i] : out.empty() ? 0 : out.back());
    }
    return out;
  }

  static void range(ColumnGuess& guess, const Column& column) {
    bool any = false;
    for (const double x : column) {
      if (!std::isfinite(x)) continue;
      guess.low = any ? std::min(guess.low, x) : x;
      guess.high = any ? std::max(guess.high, x) : x;
      any = true;
    }
    if (!any) guess.why = "no numbers";
    if (any && guess.low == guess.high) guess.why = "the same in every row";
  }

  bool open(std::size_t i) const {
    return guesses_[i].role == Role::kNone && guesses_[i].low < guesses_[i].high;
  }

  void is(std::size_t i, Role role, std::string why) {
    guesses_[i].role = role;
    guesses_[i].why = std::move(why);
  }

  static double rising_share(const Column& c) {
    double rises = 0;
    for (std::size_t i = 1; i < c.size(); ++i) rises += c[i] > c[i - 1] ? 1 : 0;
    return c.size() < 2 ? 0 : rises / static_cast<double>(c.size() - 1);
  }

  void find_time() {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      if (!open(i) || rising_share(columns_[i]) < 0.99) continue;
      const bool named = says(guesses_[i].name, {"t", "time", "stamp", "timestamp", "sec"});
      if (!best || named) best = i;
      if (named) break;
    }
    if (best) is(*best, Role::kTime, "rises in every row");
  }

  double named_as_position(std::size_t i) const {
    const auto& g = guesses_[i];
    if (says(g.name, {"ref",    "reference", "target",   "des",     "desired", "set",   "setpoint",
                      "goal",   "vel",       "velocity", "speed",   "acc",     "omega", "error",
                      "torque", "force",     "duty",     "current", "u",       "tau"})) {
      return -1;
    }
    double points = 0;
    if (says(g.name, {"pos", "position", "angle", "theta", "phi", "enc", "encoder", "meas",
                      "measured", "count", "counts", "q", "x", "y"})) {
      points += 1;
    }
    if (is_one_of(g.unit, {"m", "mm", "um", "rad", "mrad", "deg", "count", "counts"})) points += 1;
    return points;
  }

  // The best named; of those that are named alike, the one that another one leads; then the
  // smoothest.
  void find_position() {
    std::vector<std::size_t> best;
    double most = -1;
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      const double points = open(i) ? named_as_position(i) : -1;
      if (points < 0) continue;
      if (points > most) best.clear();
      if (points >= most) best.push_back(i);
      most = std::max(most, points);
    }
    if (best.empty()) return;
    std::size_t chosen = best.front();
    for (const std::size_t i : best) {
      if (correlation(columns_[i], columns_[chosen]) > kAlike) {
        chosen = lag(columns_[chosen], columns_[i]) > 0 ? i : chosen;
      } else if (most == 0 && roughness(columns_[i]) < roughness(columns_[chosen])) {
        chosen = i;
      }
    }
    position_ = chosen;
    is(chosen, Role::kPosition,
       most > 0 ? "a position by its name" : "changes least from row to row");
  }

  void find_velocities() {
    if (!position_) return;
    const std::size_t reach = std::max<std::size_t>(2, columns_[*position_].size() / 1000);
    const Column speed = slope(columns_[*position_], reach);
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      if (!open(i)) continue;
      const bool named =
          says(guesses_[i].name, {"vel", "velocity", "speed", "omega", "qd", "dq"}) ||
          guesses_[i].unit.ends_with("_per_s");
      if (named || std::abs(correlation(columns_[i], speed)) > kAlike) {
        is(i, Role::kVelocity, named ? "a speed by its name" : "follows the slope of the position");
      }
    }
  }

  void find_reference() {
    for (std::size_t i = 0; position_ && i < guesses_.size(); ++i) {
      if (!open(i) || correlation(columns_[i], columns_[*position_]) < kAlike) continue;
      is(i, Role::kReference,
         fmt::format("{} follows it {} rows later", guesses_[*position_].name,
                     std::max<std::ptrdiff_t>(0, lag(columns_[i], columns_[*position_]))));
      return;
    }
  }

  // Named as the position is, and moving on their own.
  void find_others() {
    if (!position_ || named_as_position(*position_) <= 0) return;
    int found = 0;
    for (std::size_t i = 0; i < guesses_.size() && found < kOthers; ++i) {
      if (!open(i) || named_as_position(i) < named_as_position(*position_)) continue;
      if (std::abs(correlation(columns_[i], columns_[*position_])) > kAlike) continue;
      is(i, Role::kOther, "a position by its name");
      ++found;
    }
  }

  void find_temperature() {
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      if (!open(i) || !says(guesses_[i].name, {"temp", "temperature", "celsius", "kelvin"})) {
        continue;
      }
      is(i, Role::kTemperature, "by its name");
      return;
    }
  }

  void find_input() {
    std::optional<std::size_t> best;
    double most = -1;
    std::size_t left = 0;
    for (std::size_t i = 0; i < guesses_.size(); ++i) {
      if (!open(i)) continue;
      ++left;
      double points = 0;
      if (is_one_of(guesses_[i].unit, {"N", "Nm", "V", "A", "pct"})) points += 1;
      if (says(guesses_[i].name, {"u", "duty", "pwm", "torque", "tau", "force", "current", "volt",
                                  "voltage", "cmd", "command", "input", "effort", "drive"})) {
        points += 1;
      }
      if (points > most) best = i;
      most = std::max(most, points);
    }
    if (!best) return;
    is(*best, Role::kInput,
       most > 0    ? "drives, by its name"
       : left == 1 ? "what is left"
                   : "the first of what is left: say which one drives");
  }

  std::vector<ColumnGuess> guesses_;
  std::vector<Column> columns_;
  std::optional<std::size_t> position_;
};

}  // namespace

std::vector<ColumnGuess> guess_columns(const logs::Table& table) {
  return Guesser(table).guess();
}

}  // namespace towbench::study::diagnose
