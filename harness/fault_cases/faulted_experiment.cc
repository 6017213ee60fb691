#include "harness/fault_cases/faulted_experiment.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/experiment/board_plan_text.h"
#include "harness/fault_cases/case_headline.h"
#include "harness/fault_cases/case_run.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

// The faults, each of which the carrier can have.
const FaultPlan& plan_over(const ExperimentFixture& fixture, CarrierKind carrier) {
  const auto& plan = fixture.experiment.faults;
  for (const auto& fault : plan) {
    if (const auto why = why_not_over(carrier, fault.kind); !why.empty()) {
      throw FixtureError({.file = "fault plan"},
                         fmt::format("\"{}\" over {}", describe(fault), name_of(carrier)),
                         std::string(why));
    }
  }
  return plan;
}

bool strikes(const ExperimentFixture& fixture, FaultKind kind) {
  const auto& plan = fixture.experiment.faults;
  return std::any_of(plan.begin(), plan.end(),
                     [&](const Fault& fault) { return fault.kind == kind; });
}

}  // namespace

void add_faults(ExperimentFixture& fixture, const FaultPlan& plan) {
  if (plan.empty()) {
    return;
  }
  auto& text = fixture.sources.front().text;
  for (const auto& fault : plan) {
    fixture.experiment.faults.push_back(fault);
    text += to_toml(fault);
  }
  text += kBudgetsDoNotApply;
  fixture.experiment.budgets_apply = false;
  CanonicalHash hash;
  hash.add(text);
  fixture.hash = hash.value();
}

FaultedExperiment::FaultedExperiment(const ExperimentFixture& fixture, std::uint64_t seed,
                                     CarrierKind carrier)
    : plain_(without_expectations(fixture)),
      faulted_(plain_),
      seed_(seed),
      reference_(run_reference(plain_, seed, carrier == CarrierKind::kCan)),
      prepared_(
          prepare(plan_over(fixture, carrier), plain_, *reference_, carrier == CarrierKind::kCan)) {
  auto& events = faulted_.experiment.events;
  events.insert(events.end(), prepared_.injection.events.begin(), prepared_.injection.events.end());
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  faulted_.rig.parameters = prepared_.built;
}

bool FaultedExperiment::may_end_run() const noexcept {
  const auto& link = prepared_.injection.link;
  return std::any_of(link.begin(), link.end(),
                     [](const LinkFault& fault) { return harness::may_end_run(fault.kind); });
}

bool FaultedExperiment::kills_host() const noexcept {
  return prepared_.injection.host.killed_ns.has_value();
}

CaseVerdict FaultedExperiment::judge_into(const std::filesystem::path& folder, RecordFacts facts,
                                          Judgement& judgement) const {
  auto& checks = judgement.checks;
  std::unique_ptr<CaseRecord> run;
  auto verdict = judge_case(plain_, prepared_, *reference_, seed_, &run);
  const auto& host = prepared_.injection.host;
  facts.ordinary = judgement.verdict;
  auto of_record = judge_record(folder, host, *run, facts);
  // Ticks that the host never served are no gap of the record; the rule for faults knows them.
  if (!host.stalls.empty() || !host.steps.empty() || may_end_run()) {
    std::erase_if(checks, [](const Check& check) {
      return check.name.ends_with("_complete") || check.name == "events_fired";
    });
  }
  // The requirement of the same name knows which runs end before the machine stands.
  std::erase_if(checks, [](const Check& check) { return check.name == "comes_to_rest"; });
  std::erase_if(checks, [](const Check& check) { return check.name == "console_script"; });
  if (!of_record.empty()) {
    checks.clear();  // the ordinary ones speak of a whole record
  }
  checks.insert(checks.begin(), verdict.checks.begin(), verdict.checks.end());
  checks.insert(checks.end(), of_record.begin(), of_record.end());
  // A plant that is ended takes along what it had not written yet.
  const bool plant_is_cut =
      strikes(faulted_, FaultKind::kPeerKilled) || strikes(faulted_, FaultKind::kPeerRestart);
  checks.push_back(
      recorded_run_check(folder, *run, !of_record.empty(), plant_is_cut || !of_record.empty()));
  judgement.verdict = worst_of(checks);
  judgement.judged = headline_of(verdict);
  verdict.checks = checks;
  verdict.fired = verdict.fired && std::none_of(checks.begin(), checks.end(), [](const Check& c) {
                    return c.name.ends_with("fired") && c.verdict == Verdict::kInvalid;
                  });
  verdict.handled = judgement.verdict == Verdict::kPass;
  return verdict;
}

}  // namespace towbench::harness
