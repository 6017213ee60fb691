#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "harness/falsify/objective.h"
#include "harness/falsify/onset_phases.h"
#include "harness/falsify/rule_margin.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/record_data.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/judge/judge.h"
#include "harness/record/temporary_folder.h"
#include "harness/requirements/judged_requirement.h"
#include "harness/requirements/run_signals.h"
#include "harness/snapshots/snapshots.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

std::string words_of(const FaultPlan& plan) {
  std::string text;
  for (const auto& fault : plan) {
    text += describe(fault) + '\n';
  }
  return text;
}

FaultPlan plan_of(const std::string& words) {
  FaultPlan plan;
  std::istringstream lines(words);
  for (std::string line; std::getline(lines, line);) {
    plan.push_back(parse_fault(line));
  }
  return plan;
}

// An experiment, and how it runs without a fault.
struct Fixed {
  explicit Fixed(const ExperimentFixture& fixture)
      : plain(without_expectations(fixture)),
        seed(plain.experiment.seed),
        reference(run_reference(plain, seed)) {
    if (!reference->outcome.complete) {
      throw FixtureError({.file = fixture.file.string()}, reference->outcome.reason,
                         "an experiment whose fault-free run comes to its end");
    }
  }
  ExperimentFixture plain;
  std::uint64_t seed;
  std::unique_ptr<CaseRecord> reference;
};

class InProcess final : public Objective {
 public:
  InProcess(const ExperimentFixture& fixture, Asked asked, std::size_t snapshots)
      : fixture_(fixture), asked_(std::move(asked)), nominal_(fixture) {
    if (snapshots > 0 && nominal_.plain.experiment.operator_acts.empty()) {
      snapshots_ = std::make_unique<Snapshots>(
          nominal_.plain, nominal_.seed,
          even_moments(nominal_.reference->outcome.end_ns, snapshots),
          SnapshotWork{
              .injection =
                  [this](const std::string& words) {
                    return prepare(plan_of(words), nominal_.plain, *nominal_.reference).injection;
                  },
              .answer =
                  [this](const std::string& words, std::unique_ptr<CaseRecord> run) {
                    return text_of(judge(plan_of(words), nominal_, *run));
                  }});
    }
  }

  Outcome measure(const SearchCase& one) override {
    try {
      if (one.setup.is_nominal()) {
        return snapshots_ ? from_snapshot(one.faults) : anew(one.faults, nominal_);
      }
      const TemporaryFolder folder;
      return anew(one.faults, Fixed(in_setup(fixture_, one.setup, folder.path())));
    } catch (const FixtureError& error) {
      return {.reason = error.what()};
    }
  }

  double end_s() const override { return core::seconds(nominal_.reference->outcome.end_ns); }
  std::vector<Stretch> phases_of(const FaultChoice& choice) const override {
    return onset_phases(choice, *nominal_.reference);
  }

 private:
  Outcome anew(const FaultPlan& plan, const Fixed& bench) const {
    if (plan.empty()) {
      return judge(plan, bench, *bench.reference);
    }
    const auto prepared = prepare(plan, bench.plain, *bench.reference);
    return judge(plan, bench,
                 *run_case(bench.plain, prepared.built, prepared.injection, {.seed = bench.seed}));
  }

  Outcome from_snapshot(const FaultPlan& plan) {
    const auto prepared = prepare(plan, nominal_.plain, *nominal_.reference);
    const auto first = std::min_element(prepared.onsets_ns.begin(), prepared.onsets_ns.end());
    const auto answer = snapshots_->ask(*first, words_of(plan));
    return answer ? outcome_of(*answer)
                  : Outcome{.fired = true,
                            .margin = -1,
                            .broken = true,
                            .reason = "no_crash: the process ended"};
  }

  Outcome judge(const FaultPlan& plan, const Fixed& bench, const CaseRecord& run) const {
    const auto prepared = prepare(plan, bench.plain, *bench.reference);
    const bool plainly_seen = plan.size() == 1 && plan.front().kind != FaultKind::kWelded;
    Outcome outcome;
    if (!asked_.requirement || !plainly_seen) {
      const auto verdict = judge_run(bench.plain, prepared, *bench.reference, bench.seed, run);
      outcome.fired = verdict.fired;
      if (outcome.fired && !asked_.requirement) {
        add_margin_of(verdict.checks, outcome);
        return outcome;
      }
    } else {
      outcome.fired = first_difference_ns(run, *bench.reference) >= 0;
    }
    if (outcome.fired && asked_.requirement) {
      const auto data = run_data_of(run, limits_of(bench.plain.rig.parameters));
      const auto windows = trace_windows(resolve_windows(bench.plain.experiment.windows, data));
      const auto judged = judge_requirement(*asked_.requirement, trace_of(data, windows));
      outcome.margin = judged.check.margin;
      outcome.broken = judged.check.verdict == Verdict::kFail;
      outcome.reason = judged.check.reason;
    }
    return outcome;
  }

  static std::string text_of(const Outcome& outcome) {
    return json{{"fired", outcome.fired},
                {"margin", outcome.margin ? json(*outcome.margin) : json(nullptr)},
                {"broken", outcome.broken},
                {"reason", outcome.reason},
                {"rules", outcome.rules}}
        .dump(-1, ' ', false, json::error_handler_t::replace);
  }
  static Outcome outcome_of(const std::string& text) {
    const auto line = json::parse(text);
    Outcome outcome{.fired = line.at("fired"),
                    .broken = line.at("broken"),
                    .reason = line.at("reason"),
                    .rules = line.at("rules")};
    if (!line.at("margin").is_null()) {
      outcome.margin = line.at("margin").get<double>();
    }
    return outcome;
  }

  ExperimentFixture fixture_;
  Asked asked_;
  Fixed nominal_;
  std::unique_ptr<Snapshots> snapshots_{};
};

}  // namespace

std::unique_ptr<Objective> in_process_objective(const ExperimentFixture& fixture, Asked asked,
                                                std::size_t snapshots) {
  return std::make_unique<InProcess>(fixture, std::move(asked), snapshots);
}

}  // namespace towbench::harness
