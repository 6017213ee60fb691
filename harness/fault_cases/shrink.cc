#include "harness/fault_cases/shrink.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <regex>

#include <fmt/format.h>

#include "harness/experiment/experiment_toml.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"

namespace towbench::harness {
namespace {

constexpr std::size_t kMostTrials = 600;
// Below these nothing is told any more.
constexpr double kSmallestNumber = 1e-3;
constexpr double kSmallestTime_s = 1e-3;

// The first requirement that the run breaks; none when it breaks none or cannot be.
std::optional<Check> broken_rule(const ExperimentFixture& fixture, const CaseJudge& judge,
                                 const std::string& wanted) {
  try {
    const auto checks = judge(fixture);
    if (worst_of(checks) != Verdict::kFail) {
      return std::nullopt;  // one that cannot be judged is no smaller failure
    }
    for (const auto& check : checks) {
      if (check.verdict == Verdict::kFail && (wanted.empty() || check.name == wanted)) {
        return check;
      }
    }
  } catch (const FixtureError&) {
    // A trigger whose condition is not met any more.
  }
  return std::nullopt;
}

// Halved and, if that is too much, to two digits, then one.
std::vector<double> simpler(double value) {
  std::vector<double> values;
  if (std::fabs(value) > 2 * kSmallestNumber) {
    values.push_back(value / 2);
  }
  for (const int digits : {1, 2}) {
    const double rounded = std::stod(fmt::format("{:.{}g}", value, digits));
    if (rounded != value) {
      values.push_back(rounded);
    }
  }
  return values;
}

class Shrinker {
 public:
  Shrinker(ExperimentFixture fixture, const CaseJudge& judge, std::string rule)
      : best_(std::move(fixture)), judge_(judge), rule_(std::move(rule)) {}

  void run() {
    bool smaller = true;
    while (smaller && trials_ < kMostTrials) {
      smaller = false;
      smaller |= drop_each(&Experiment::faults);
      smaller |= drop_each(&Experiment::events);
      smaller |= drop_each(&Experiment::console);
      smaller |= calm_steps();
      smaller |= simplify_commands();
      smaller |= simplify_faults();
    }
    shorten();
  }

  [[nodiscard]] ExperimentFixture& best() noexcept { return best_; }
  [[nodiscard]] std::size_t trials() const noexcept { return trials_; }

 private:
  // Kept when it still fails in the same way.
  bool keep(const std::function<void(Experiment&)>& change) {
    if (trials_ >= kMostTrials) {
      return false;
    }
    auto candidate = best_;
    change(candidate.experiment);
    ++trials_;
    if (!broken_rule(candidate, judge_, rule_)) {
      return false;
    }
    best_ = std::move(candidate);
    return true;
  }

  template <typename Part>
  bool drop_each(std::vector<Part> Experiment::*parts) {
    bool dropped = false;
    const bool is_plan = std::is_same_v<Part, Fault>;
    for (std::size_t i = (best_.experiment.*parts).size(); i-- > 0;) {
      if (is_plan && (best_.experiment.*parts).size() == 1) {
        break;  // without a fault there is nothing to judge
      }
      dropped |= keep([&](Experiment& experiment) {
        auto& list = experiment.*parts;
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
      });
    }
    return dropped;
  }

  bool calm_steps() {
    bool calmed = false;
    for (std::size_t i = 0; i < best_.experiment.console.size(); ++i) {
      if (best_.experiment.console[i].wait_s > 0) {
        calmed |= keep([&](Experiment& experiment) { experiment.console[i].wait_s = 0; });
      }
      if (best_.experiment.console[i].at_s) {
        calmed |= keep([&](Experiment& experiment) { experiment.console[i].at_s.reset(); });
      }
    }
    return calmed;
  }

  // Numbers with a unit behind them, from the last to the first: those of options before the
  // distance.
  bool simplify_commands() {
    static const std::regex kNumber(R"(-?\d+(\.\d+)?(?=(m/s|mm|m|s|%)))");
    bool any = false;
    for (std::size_t i = 0; i < best_.experiment.console.size(); ++i) {
      const auto count = [&] {
        const auto& text = best_.experiment.console[i].send;
        return static_cast<std::size_t>(
            std::distance(std::sregex_iterator(text.begin(), text.end(), kNumber), {}));
      };
      for (std::size_t number = count(); number-- > 0;) {
        bool smaller = true;
        while (smaller) {
          const auto text = best_.experiment.console[i].send;
          auto match = std::sregex_iterator(text.begin(), text.end(), kNumber);
          std::advance(match, static_cast<std::ptrdiff_t>(number));
          const auto value = std::stod(match->str());
          const auto head = text.substr(0, static_cast<std::size_t>(match->position()));
          const auto tail =
              text.substr(static_cast<std::size_t>(match->position() + match->length()));
          const auto candidates = simpler(value);
          smaller = std::any_of(candidates.begin(), candidates.end(), [&](double simple) {
            return keep([&](Experiment& experiment) {
              experiment.console[i].send = fmt::format("{}{:.6g}{}", head, simple, tail);
            });
          });
          any |= smaller;
        }
      }
    }
    return any;
  }

  bool simplify_faults() {
    bool any = false;
    for (std::size_t i = 0; i < best_.experiment.faults.size(); ++i) {
      const auto fault = best_.experiment.faults[i];
      if (fault.trigger.kind == FaultTrigger::Kind::kTime) {
        any |= round_time(i, &FaultTrigger::value);
      }
      if (fault.trigger.after_s > kSmallestTime_s) {
        any |= round_time(i, &FaultTrigger::after_s);
      }
      if (fault.duration_s && *fault.duration_s > kSmallestTime_s) {
        any |= keep([&](Experiment& experiment) {
          experiment.faults[i].duration_s = *fault.duration_s / 2;
        });
      }
      for (std::size_t k = 0; k < kMostFaultParameters; ++k) {
        const auto& parameter = fault.row().parameters[k];
        if (!parameter.key.empty() && fault.parameters[k] != parameter.standard) {
          any |= keep([&](Experiment& experiment) {
            experiment.faults[i].parameters[k] = parameter.standard;
          });
        }
      }
    }
    return any;
  }

  // To the millisecond.
  bool round_time(std::size_t i, double FaultTrigger::*time) {
    const double value = best_.experiment.faults[i].trigger.*time;
    const double rounded = std::floor(value / kSmallestTime_s + 0.5) * kSmallestTime_s;
    return rounded != value &&
           keep([&](Experiment& experiment) { experiment.faults[i].trigger.*time = rounded; });
  }

  // Time limit: as long as it has to be.
  void shorten() {
    while (best_.experiment.duration_limit_s > 2 * kSmallestTime_s &&
           keep([](Experiment& experiment) { experiment.duration_limit_s *= 0.75; })) {
    }
  }

  ExperimentFixture best_;
  const CaseJudge& judge_;
  std::string rule_;
  std::size_t trials_ = 0;
};

}  // namespace

ShrunkCase shrink(const ExperimentFixture& failing, std::uint64_t seed) {
  auto plain = without_expectations(failing);
  plain.experiment.seed = seed;
  return shrink(plain, [seed](const ExperimentFixture& fixture) {
    const auto reference = run_reference(fixture, seed);
    const auto prepared = prepare(fixture.experiment.faults, fixture, *reference);
    return judge_case(fixture, prepared, *reference, seed).checks;
  });
}

ShrunkCase shrink(const ExperimentFixture& failing, const CaseJudge& judge) {
  if (failing.experiment.faults.empty()) {
    throw FixtureError({.file = failing.file.string()}, "a run without faults",
                       "one with faults: only those are judged by requirements");
  }
  auto plain = failing;
  plain.experiment.windows.resize(1);
  plain.experiment.budgets.clear();
  plain.experiment.requirements.clear();
  const auto broken = broken_rule(plain, judge, "");
  if (!broken) {
    throw FixtureError({.file = failing.file.string()}, "a run that breaks no requirement",
                       "a failing one");
  }
  Shrinker shrinker(std::move(plain), judge, broken->name);
  shrinker.run();

  ShrunkCase shrunk;
  shrunk.rule = broken->name;
  shrunk.trials = shrinker.trials();
  shrunk.fixture = std::move(shrinker.best());
  auto& experiment = shrunk.fixture.experiment;
  constexpr std::size_t kLongestName = 52;
  experiment.name = experiment.name.substr(0, kLongestName) + "-shrunk";
  experiment.title = "Smallest run found that breaks " + shrunk.rule;
  experiment.description =
      fmt::format("From {}, in {} trials.", failing.experiment.name, shrunk.trials);
  shrunk.fixture.sources.front().text = to_toml(shrunk.fixture);
  CanonicalHash hash;
  hash.add(shrunk.fixture.sources.front().text);
  shrunk.fixture.hash = hash.value();
  if (const auto again = broken_rule(shrunk.fixture, judge, shrunk.rule)) {
    shrunk.reason = again->reason;
  }
  return shrunk;
}

}  // namespace towbench::harness
