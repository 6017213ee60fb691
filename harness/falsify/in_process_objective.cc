#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "harness/falsify/objective.h"
#include "harness/falsify/rule_margin.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/record_data.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/judge/judge.h"
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

class InProcess final : public Objective {
 public:
  InProcess(const ExperimentFixture& fixture, Asked asked, std::size_t snapshots)
      : plain_(without_expectations(fixture)),
        asked_(std::move(asked)),
        seed_(plain_.experiment.seed),
        reference_(run_reference(plain_, seed_)) {
    if (!reference_->outcome.complete) {
      throw FixtureError({.file = fixture.file.string()}, reference_->outcome.reason,
                         "an experiment whose fault-free run comes to its end");
    }
    if (snapshots > 0 && plain_.experiment.hand.empty()) {
      snapshots_ = std::make_unique<Snapshots>(
          plain_, seed_, even_moments(reference_->outcome.end_ns, snapshots),
          SnapshotWork{.injection =
                           [this](const std::string& words) {
                             return prepare(plan_of(words), plain_, *reference_).injection;
                           },
                       .answer =
                           [this](const std::string& words, std::unique_ptr<CaseRecord> run) {
                             return text_of(judge(plan_of(words), *run));
                           }});
    }
  }

  Outcome measure(const FaultPlan& plan) override {
    PreparedPlan prepared;
    try {
      prepared = prepare(plan, plain_, *reference_);
    } catch (const FixtureError& error) {
      return {.reason = error.what()};
    }
    if (!snapshots_) {
      return judge(plan, *run_case(plain_, prepared.built, prepared.injection, {.seed = seed_}));
    }
    const auto first = std::min_element(prepared.onsets_ns.begin(), prepared.onsets_ns.end());
    const auto answer = snapshots_->ask(*first, words_of(plan));
    return answer ? outcome_of(*answer)
                  : Outcome{.fired = true,
                            .margin = -1,
                            .broken = true,
                            .reason = "no_crash: the process ended"};
  }

  double end_s() const override { return core::seconds(reference_->outcome.end_ns); }

 private:
  Outcome judge(const FaultPlan& plan, const CaseRecord& run) const {
    const auto prepared = prepare(plan, plain_, *reference_);
    const bool plainly_seen = plan.size() == 1 && plan.front().kind != FaultKind::kWelded;
    Outcome outcome;
    if (!asked_.requirement || !plainly_seen) {
      const auto verdict = judge_run(plain_, prepared, *reference_, seed_, run);
      outcome.fired = verdict.fired;
      if (outcome.fired && !asked_.requirement) {
        add_margin_of(verdict.checks, outcome);
        return outcome;
      }
    } else {
      outcome.fired = first_difference_ns(run, *reference_) >= 0;
    }
    if (outcome.fired && asked_.requirement) {
      const auto data = run_data_of(run, limits_of(plain_.rig.parameters));
      const auto windows = trace_windows(resolve_windows(plain_.experiment.windows, data));
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
                {"reason", outcome.reason}}
        .dump(-1, ' ', false, json::error_handler_t::replace);
  }
  static Outcome outcome_of(const std::string& text) {
    const auto line = json::parse(text);
    Outcome outcome{
        .fired = line.at("fired"), .broken = line.at("broken"), .reason = line.at("reason")};
    if (!line.at("margin").is_null()) {
      outcome.margin = line.at("margin").get<double>();
    }
    return outcome;
  }

  ExperimentFixture plain_;
  Asked asked_;
  std::uint64_t seed_;
  std::unique_ptr<CaseRecord> reference_;
  std::unique_ptr<Snapshots> snapshots_{};
};

}  // namespace

std::unique_ptr<Objective> in_process_objective(const ExperimentFixture& fixture, Asked asked,
                                                std::size_t snapshots) {
  return std::make_unique<InProcess>(fixture, std::move(asked), snapshots);
}

}  // namespace towbench::harness
