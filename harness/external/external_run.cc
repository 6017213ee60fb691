#include "harness/external/external_run.h"

#include <algorithm>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <sys/mman.h>

#include "harness/checks/recorded_axes.h"
#include "harness/external/arrival.h"
#include "harness/external/external_bench.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/judge/safety_checks.h"
#include "harness/link/refusals.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/wall_clock_carrier.h"
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

// By the wall clock a wire that cannot bear the worst case is refused before the clock begins.
std::string why_not_by_the_clock(const ExternalController& controller, const protocol::Hello& hello,
                                 const emulator::RigParameters& rig) {
  if (!controller.address) {
    return {};
  }
  const auto bears = bears_by_the_wall_clock(
      *controller.address,
      {.lockstep = true,  // turns cross as they do there
       .exchange_ns = hello.exchange_ns,
       .references = (hello.capabilities & protocol::kCapabilityReference) != 0,
       .absolute_counts = (hello.capabilities & protocol::kCapabilityAbsolute) != 0 &&
                          emulator::tells_counts(rig)});
  if (!bears) {
    return bears.error().message;
  }
  const bool wants_edges = (hello.capabilities & protocol::kCapabilityEdges) != 0;
  return wants_edges && !bears_every_tick(controller.address->scheme)
             ? controller.address->text() + " bears no edges by the wall clock: ask for the digest"
             : std::string{};
}

// What is played, into which files.
struct Play {
  const ExperimentFixture& fixture;
  const std::vector<LinkFault>& link_faults;
  const ExternalPlay& how;
  CaseRecord* record = nullptr;
  std::vector<std::string>& refused;
  std::unique_ptr<ExternalTiming>& timing;
};

// Rights are of a thread of its own and end with it: no process inherits them.
RunOutcome run_by_the_clock(ExternalBench& bench, Arrival& arrival, const Play& what) {
  RunOutcome outcome;
  outcome.reason =
      why_not_by_the_clock(what.how.controller, arrival.hello(), what.fixture.rig.parameters);
  if (!outcome.reason.empty()) {
    return outcome;
  }
  std::thread([&] {
    go_by_the_wall_clock(arrival.connection());
    what.timing = std::make_unique<ExternalTiming>(arrival.hello().exchange_ns);
    outcome = bench.run_by_the_wall_clock(arrival.hello(), what.timing->loop(),
                                          what.timing->answers(), what.how.watchers);
  }).join();
  (void)munlockall();
  return outcome;
}

// Files of both sides in the folder.
RunOutcome play_external(const Play& what, const std::filesystem::path& folder) {
  const auto& fixture = what.fixture;
  const auto& how = what.how;
  Arrival arrival(how.controller, folder / kPrinted, how.watchers);
  PlantRecorder files(folder, fixture.rig.parameters, how.tap);
  FirmwareRecorder recorder(folder, FirmwareRecorder::Log::kTelemetry,
                            recorded_axes(fixture.rig.parameters.axes));
  TwoObservers both(files, what.record);
  RunOutcome outcome;
  outcome.reason = arrival.await();
  if (!outcome.reason.empty()) {
    return outcome;
  }
  ThinnedTruth thinned(both, how.by_wall_clock ? arrival.hello().exchange_ns : 0);
  StandstillWatch standstill(thinned);
  Refusals refusals(standstill, [&](const std::string& line) { what.refused.push_back(line); });
  emulator::PlantNode node(fixture.rig.parameters, how.seed, fixture.experiment.events, refusals);
  ReplayedOperator repeated(fixture.experiment.operator_acts);
  Operator* const run_operator =
      how.run_operator == nullptr && !fixture.experiment.operator_acts.empty() ? &repeated
                                                                               : how.run_operator;
  ExternalBench bench(fixture, {node, standstill, refusals.heard()}, arrival.link(),
                      what.link_faults, {recorder, what.record, how.tap}, run_operator);
  outcome = how.by_wall_clock ? run_by_the_clock(bench, arrival, what)
                              : bench.run(arrival.hello(), how.watchers);
  if (const auto dropped = Refusals::dropped(arrival.link().counts()); !dropped.empty()) {
    what.refused.push_back("dropped: " + dropped);
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

// In lockstep, into files that are not kept.
std::shared_ptr<const ReferenceRun> play_aside(const ExperimentFixture& fixture,
                                               const std::vector<LinkFault>& link_faults,
                                               const ExternalPlay& how) {
  auto run = std::make_shared<ReferenceRun>();
  run->record.of_bbmc = false;
  run->record.has_further_axes = emulator::has_further_axes(fixture.rig.parameters);
  std::vector<std::string> unused;
  std::unique_ptr<ExternalTiming> none;
  run->record.outcome =
      play_external({fixture, link_faults, how, &run->record, unused, none}, run->files.path());
  return run;
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
  return play_aside(sound, {}, {.controller = controller, .seed = seed, .watchers = watchers});
}

ExternalRun::ExternalRun(const ExperimentFixture& fixture, const ExternalPlay& how,
                         std::shared_ptr<const ReferenceRun> reference)
    : how_(how), fixture_(fixture), reference_(std::move(reference)) {
  require_reference(fixture);
  prepare_faults();
}

void ExternalRun::prepare_faults() {
  without_.clear();
  if (fixture_.experiment.faults.empty()) {
    reference_.reset();
    return;
  }
  refuse_faults_beyond(fixture_.experiment.faults, FaultReach::kMachineAndLink);
  auto sound = fixture_;
  if (!reference_) {
    reference_ = run_external_reference(sound, how_.controller, how_.seed, how_.watchers);
  }
  require_good_end(reference_->record.outcome);
  const auto prepared = prepare_without_bbmc(sound, reference_->record);
  if (const auto pressed = pressed_where_welded(sound, prepared)) {
    reference_ = run_external_reference(*pressed, how_.controller, how_.seed, how_.watchers);
    require_good_end(reference_->record.outcome);
  }
  fixture_ = with_faults(sound, prepared);
  link_faults_ = prepared.injection.link;
  for (const auto& left_out : each_left_out(sound, prepared, reference_->record)) {
    without_.push_back({left_out.fault, play_aside(left_out.fixture, left_out.link,
                                                   {.controller = how_.controller,
                                                    .seed = how_.seed,
                                                    .watchers = how_.watchers})});
  }
}

void ExternalRun::take_over(const ExperimentFixture& driven) {
  fixture_ = driven;
  prepare_faults();
}

RunOutcome ExternalRun::play(const std::filesystem::path& folder) {
  return play_external({fixture_, link_faults_, how_, nullptr, refused_, timing_}, folder);
}

std::string ExternalRun::judge_timing_into(const std::filesystem::path& folder,
                                           Judgement& judgement) const {
  return timing_ ? timing_->judge_into(folder, judgement) : std::string{};
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
    return check.name == "console_script" ||
           (reference_ && (check.name == "edges_seen" || check.name == "driven_by_hand"));
  });
  const bool is_disturbed = std::any_of(link_faults_.begin(), link_faults_.end(),
                                        [](const LinkFault& fault) { return fault.to_plant; });
  std::vector<Check> added;
  if (reference_) {
    added = judge_beside_reference(folder, folder / kReferenceFolder, without_);
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
