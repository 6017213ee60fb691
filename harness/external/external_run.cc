#include "harness/external/external_run.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/external/arrival.h"
#include "harness/external/external_bench.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/judge/safety_checks.h"
#include "harness/link/refusals.h"
#include "harness/record/plant_recorder.h"
#include "harness/record/two_observers.h"

namespace towbench::harness {
namespace {

constexpr const char* kReferenceFolder = "reference";
constexpr const char* kPrinted = "controller.txt";

Check stayed(const RunOutcome& outcome) {
  Check check;
  check.name = "controller_stays";
  check.meaning = "the controller is there until the bench ends the run";
  check.source = "ANY-6";
  check.verdict = outcome.script_failure.empty() ? Verdict::kPass : Verdict::kFail;
  check.reason = outcome.script_failure;
  return check;
}

Check makes_sense(const std::vector<std::string>& refused) {
  Check check;
  check.name = "messages_accepted";
  check.meaning = "the plant takes every message of the controller";
  check.source = "ANY-7";
  check.value = static_cast<double>(refused.size());
  check.max = 0;
  check.verdict = refused.empty() ? Verdict::kPass : Verdict::kFail;
  check.reason = refused.empty() ? "" : refused.front();
  return check;
}

// What is played.
struct Play {
  const ExperimentFixture& fixture;
  const std::vector<LinkFault>& link_faults;
  const ExternalController& controller;
  std::uint64_t seed = 0;
  const LoopWatchers& watchers;
};

// Files of both sides in the folder; `record` may be null.
RunOutcome play_external(const Play& what, const std::filesystem::path& folder, CaseRecord* record,
                         std::vector<std::string>& refused) {
  const auto& fixture = what.fixture;
  Arrival arrival(what.controller, folder / kPrinted, what.watchers);
  PlantRecorder files(folder, nullptr);
  TwoObservers both(files, record);
  StandstillWatch standstill(both);
  Refusals refusals(standstill, [&](const std::string& line) { refused.push_back(line); });
  emulator::PlantNode node(fixture.rig.parameters, what.seed, fixture.experiment.events, refusals);
  FirmwareRecorder recorder(folder, FirmwareRecorder::Log::kTelemetry);
  RunOutcome outcome;
  outcome.reason = arrival.await();
  if (!outcome.reason.empty()) {
    return outcome;
  }
  ExternalBench bench(fixture, {node, standstill, refusals.heard()}, arrival.link(),
                      what.link_faults, recorder, record);
  outcome = bench.run(arrival.hello(), what.watchers);
  if (const auto dropped = Refusals::dropped(arrival.link().counts()); !dropped.empty()) {
    refused.push_back("dropped: " + dropped);
  }
  if (const auto trouble = arrival.join(); !trouble.empty() && outcome.script_failure.empty()) {
    outcome.script_failure = trouble;
  }
  files.flush();
  recorder.flush();
  outcome.log_rows = recorder.rows();
  outcome.writes_succeeded = recorder.good() && files.good();
  return outcome;
}

void require_reference(const ExperimentFixture& fixture) {
  if (fixture.experiment.reference.empty()) {
    throw FixtureError({fixture.file.string()}, "no [[reference]]",
                       "an experiment that states one: its console is BBMC's alone");
  }
}

void require_good_end(const RunOutcome& outcome) {
  if (!outcome.complete || !outcome.script_failure.empty()) {
    throw FixtureError({.file = "fault plan"},
                       "a run without the faults that does not end well: " + outcome.reason +
                           outcome.script_failure,
                       "a controller that keeps the sound machine going");
  }
}

}  // namespace

std::shared_ptr<const ReferenceRun> run_external_reference(const ExperimentFixture& sound,
                                                           const ExternalController& controller,
                                                           std::uint64_t seed,
                                                           const LoopWatchers& watchers) {
  require_reference(sound);
  auto run = std::make_shared<ReferenceRun>();
  run->record.of_bbmc = false;
  std::vector<std::string> unused;
  run->record.outcome = play_external({sound, {}, controller, seed, watchers}, run->files.path(),
                                      &run->record, unused);
  return run;
}

ExternalRun::ExternalRun(const ExperimentFixture& fixture, const ExternalController& controller,
                         std::uint64_t seed, const LoopWatchers& watchers,
                         std::shared_ptr<const ReferenceRun> reference)
    : controller_(controller),
      seed_(seed),
      watchers_(watchers),
      fixture_(fixture),
      reference_(std::move(reference)) {
  require_reference(fixture);
  if (fixture.experiment.faults.empty()) {
    reference_.reset();
    return;
  }
  refuse_faults_beyond(fixture.experiment.faults, FaultReach::kMachineAndLink);
  const auto sound = fixture_;
  if (!reference_) {
    reference_ = run_external_reference(sound, controller_, seed_, watchers_);
  }
  require_good_end(reference_->record.outcome);
  const auto prepared = prepare_without_bbmc(sound, reference_->record);
  if (const auto pressed = pressed_where_welded(sound, prepared)) {
    reference_ = run_external_reference(*pressed, controller_, seed_, watchers_);
    require_good_end(reference_->record.outcome);
  }
  fixture_ = with_faults(sound, prepared);
  link_faults_ = prepared.injection.link;
}

RunOutcome ExternalRun::play(const std::filesystem::path& folder) {
  return play_external({fixture_, link_faults_, controller_, seed_, watchers_}, folder, nullptr,
                       refused_);
}

void ExternalRun::keep_reference(const std::filesystem::path& folder) const {
  if (reference_) {
    reference_->copy_to(folder / kReferenceFolder);
  }
}

void ExternalRun::judge_into(const std::filesystem::path& folder, const RunOutcome& outcome,
                             Judgement& judgement) const {
  auto& checks = judgement.checks;
  // A fault may keep an axis from moving at all, and the run without it has moved.
  std::erase_if(checks, [&](const Check& check) {
    return check.name == "console_script" || (reference_ && check.name == "edges_seen");
  });
  const bool is_disturbed = std::any_of(link_faults_.begin(), link_faults_.end(),
                                        [](const LinkFault& fault) { return fault.to_plant; });
  std::vector<Check> added;
  if (reference_) {
    added = judge_beside_reference(folder, folder / kReferenceFolder);
  }
  added.push_back(stayed(outcome));
  if (!is_disturbed) {  // else what arrives is not what was sent
    added.push_back(makes_sense(refused_));
  }
  judge_safety(folder, limits_of(fixture_.rig.parameters), {}, checks);
  checks.insert(checks.begin(), added.begin(), added.end());
  judgement.verdict = worst_of(checks);
}

}  // namespace towbench::harness
