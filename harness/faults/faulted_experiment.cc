#include "harness/faults/faulted_experiment.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/faults/case_run.h"
#include "harness/faults/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/judge/csv_table.h"

namespace towbench::harness {
namespace {

// The folder was written by a second run of the same bits; were it another run, its verdict would
// be about something else.
Check recorded_run_check(const std::filesystem::path& folder, const CaseRecord& run) {
  Check check;
  check.name = "recorded_run_is_judged";
  check.meaning = "the record on disk is the run that was judged for faults";
  const auto same_end = [&](const CsvTable& table, std::size_t rows) {
    return table.rows() == rows;
  };
  const auto truth = CsvTable::load(folder / "truth.csv");
  const auto log = CsvTable::load(folder / "log.csv");
  bool same = same_end(truth, run.truth.size()) && same_end(log, run.log.size());
  for (const auto axis : core::kAxes) {
    const auto column = truth.column(fmt::format("{}_carriage_m", core::name_of(axis)));
    const auto duty = log.column(fmt::format("{}_duty_pct", core::name_of(axis)));
    for (std::size_t i = 0; same && i < column.size(); ++i) {
      same = column[i] == run.truth[i].axes[axis].carriage_m;
    }
    for (std::size_t i = 0; same && i < duty.size(); ++i) {
      same = duty[i] == run.log[i].axes[axis].duty_pct;
    }
  }
  check.verdict = same ? Verdict::kPass : Verdict::kInvalid;
  check.reason = same ? "" : "truth.csv or log.csv differs from it";
  return check;
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
  fixture.experiment.budgets_apply = false;
  CanonicalHash hash;
  hash.add(text);
  fixture.hash = hash.value();
}

FaultedExperiment::FaultedExperiment(const ExperimentFixture& fixture, std::uint64_t seed)
    : plain_(without_expectations(fixture)),
      faulted_(plain_),
      seed_(seed),
      twin_(run_twin(plain_, seed)),
      prepared_(prepare(fixture.experiment.faults, plain_, *twin_)) {
  auto& events = faulted_.experiment.events;
  events.insert(events.end(), prepared_.injection.events.begin(), prepared_.injection.events.end());
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  faulted_.rig.parameters = prepared_.built;
}

bool FaultedExperiment::kills_plant() const noexcept {
  return std::any_of(prepared_.injection.link.begin(), prepared_.injection.link.end(),
                     [](const LinkFault& fault) { return fault.kind == FaultKind::kPeerKilled; });
}

void FaultedExperiment::judge_into(const std::filesystem::path& folder,
                                   Judgement& judgement) const {
  auto& checks = judgement.checks;
  std::unique_ptr<CaseRecord> run;
  auto verdict = judge_case(plain_, prepared_, *twin_, seed_, &run);
  // Ticks that the host never served are no gap of the record; the rule for faults knows them.
  if (!prepared_.injection.host.stalls.empty() || kills_plant()) {
    std::erase_if(checks, [](const Check& check) {
      return check.name == "log_complete" || check.name == "truth_complete" ||
             check.name == "events_fired";
    });
  }
  std::erase_if(checks, [](const Check& check) { return check.name == "console_script"; });
  checks.insert(checks.begin(), verdict.checks.begin(), verdict.checks.end());
  checks.push_back(recorded_run_check(folder, *run));
  judgement.verdict = worst_of(checks);
}

}  // namespace towbench::harness
