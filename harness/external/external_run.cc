#include "harness/external/external_run.h"

#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "harness/external/controller_process.h"
#include "harness/external/external_bench.h"
#include "harness/fault_cases/machine_faults.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/judge/safety_checks.h"
#include "harness/link/refusals.h"
#include "harness/record/plant_recorder.h"
#include "protocol/carriers/connection.h"

namespace towbench::harness {
namespace {

constexpr const char* kReferenceFolder = "reference";
constexpr const char* kPrinted = "controller.txt";
constexpr auto kProcessComes = std::chrono::seconds(10);
constexpr auto kSomebodyComes = std::chrono::seconds(60);

// To the files and, where there is one, to memory.
class Both final : public emulator::PlantObserver {
 public:
  Both(emulator::PlantObserver& files, emulator::PlantObserver* memory) noexcept
      : files_(files), memory_(memory) {}
  void on_truth(const emulator::TruthRow& row) noexcept override {
    files_.on_truth(row);
    if (memory_ != nullptr) {
      memory_->on_truth(row);
    }
  }
  void on_event(const emulator::PlantEvent& event) noexcept override {
    files_.on_event(event);
    if (memory_ != nullptr) {
      memory_->on_event(event);
    }
  }

 private:
  emulator::PlantObserver& files_;
  emulator::PlantObserver* memory_;
};

std::string with_address(std::string command, const std::string& address) {
  constexpr std::string_view kPlaceholder = "{address}";
  for (auto at = command.find(kPlaceholder); at != std::string::npos;
       at = command.find(kPlaceholder, at + address.size())) {
    command.replace(at, kPlaceholder.size(), address);
  }
  return command;
}

// Waits for the controller to come and greet; starts it where it is the bench's to start.
class Arrival {
 public:
  Arrival(const ExternalController& controller, const std::filesystem::path& folder,
          const LoopWatchers& watchers)
      : controller_(controller), printed_(folder / kPrinted), watchers_(watchers) {
    if (controller.address) {
      address_ = *controller.address;
    } else {
      address_.place = (socket_.path() / "bench").string();
    }
    deadline_ = Clock::now() + (controller.address ? kSomebodyComes : kProcessComes);
  }

  // Empty when a controller has greeted; else why not.
  [[nodiscard]] std::string await() {
    const auto keep_waiting = [this] { return goes_on(); };
    auto opened = protocol::Connection::to_controller(address_, keep_waiting);
    if (!opened) {
      return opened.error().message;
    }
    if (*opened == nullptr) {
      return nobody_came();
    }
    connection_ = std::move(*opened);
    const auto hello = connection_->await_hello(keep_waiting);
    if (!hello) {
      return nobody_came();
    }
    hello_ = *hello;
    return {};
  }

  [[nodiscard]] protocol::TurnLink& link() { return connection_->link(); }
  [[nodiscard]] const protocol::Hello& hello() const { return hello_; }
  // What the process did at its end that it should not; empty when there is none.
  [[nodiscard]] std::string join() {
    connection_.reset();
    const auto how = process_ ? process_->join() : std::string{};
    return how.empty() ? how : "the controller's process " + how;
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Asked when the bench listens already.
  bool goes_on() {
    if (!told_ && watchers_.waiting && controller_.address) {
      watchers_.waiting(address_.text());
    }
    told_ = true;
    if (!controller_.address && !process_) {
      process_.emplace(with_address(controller_.command, address_.text()), printed_);
    }
    const bool stopped = watchers_.stop != nullptr && watchers_.stop->load();
    return !stopped && Clock::now() < deadline_ && (!process_ || process_->runs());
  }

  std::string nobody_came() {
    if (process_ && !process_->runs()) {
      const auto how = process_->join();
      return fmt::format("the controller's process {} before it greeted; see {}",
                         how.empty() ? "ended" : how, printed_.string());
    }
    return fmt::format("no controller greeted at {}", address_.text());
  }

  const ExternalController& controller_;
  std::filesystem::path printed_;
  const LoopWatchers& watchers_;
  TemporaryFolder socket_;  // that only this user may enter
  protocol::CarrierAddress address_;
  Clock::time_point deadline_;
  bool told_ = false;
  std::unique_ptr<protocol::Connection> connection_;
  protocol::Hello hello_;
  std::optional<ControllerProcess> process_;
};

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

}  // namespace

ExternalRun::ExternalRun(const ExperimentFixture& fixture, const ExternalController& controller,
                         std::uint64_t seed, const LoopWatchers& watchers)
    : controller_(controller), seed_(seed), watchers_(watchers), fixture_(fixture) {
  if (fixture.experiment.reference.empty()) {
    throw FixtureError({fixture.file.string()}, "no [[reference]]",
                       "an experiment that states one: its console is BBMC's alone");
  }
  if (fixture.experiment.faults.empty()) {
    return;
  }
  refuse_faults_beyond_machine(fixture.experiment.faults);
  const auto sound = fixture_;
  make_reference(sound);
  const auto prepared = prepare_without_events(sound, reference_->record);
  if (const auto pressed = pressed_where_welded(sound, prepared)) {
    make_reference(*pressed);
  }
  fixture_ = with_faults(sound, prepared);
}

void ExternalRun::make_reference(const ExperimentFixture& sound) {
  reference_ = std::make_unique<Reference>();
  auto& record = reference_->record;
  std::vector<std::string> unused;
  record.outcome = play(sound, reference_->files.path(), &record, unused);
  const auto& outcome = record.outcome;
  if (!outcome.complete || !outcome.script_failure.empty()) {
    throw FixtureError({.file = "fault plan"},
                       "a run without the faults that does not end well: " + outcome.reason +
                           outcome.script_failure,
                       "a controller that keeps the sound machine going");
  }
}

RunOutcome ExternalRun::play(const std::filesystem::path& folder) {
  return play(fixture_, folder, nullptr, refused_);
}

RunOutcome ExternalRun::play(const ExperimentFixture& fixture, const std::filesystem::path& folder,
                             CaseRecord* record, std::vector<std::string>& refused) const {
  Arrival arrival(controller_, folder, watchers_);
  PlantRecorder files(folder, nullptr);
  Both both(files, record);
  StandstillWatch standstill(both);
  Refusals refusals(standstill, [&](const std::string& line) { refused.push_back(line); });
  emulator::PlantNode node(fixture.rig.parameters, seed_, fixture.experiment.events, refusals);
  FirmwareRecorder recorder(folder, FirmwareRecorder::Log::kTelemetry);
  RunOutcome outcome;
  outcome.reason = arrival.await();
  if (!outcome.reason.empty()) {
    return outcome;
  }
  ExternalBench bench(fixture, {node, standstill, refusals.heard()}, arrival.link(), recorder,
                      record);
  outcome = bench.run(arrival.hello(), watchers_);
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

void ExternalRun::keep_reference(const std::filesystem::path& folder) const {
  if (reference_) {
    std::filesystem::copy(reference_->files.path(), folder / kReferenceFolder,
                          std::filesystem::copy_options::recursive);
  }
}

void ExternalRun::judge_into(const std::filesystem::path& folder, const RunOutcome& outcome,
                             Judgement& judgement) const {
  auto& checks = judgement.checks;
  std::erase_if(checks, [](const Check& check) { return check.name == "console_script"; });
  std::vector<Check> added;
  if (reference_) {
    added = judge_beside_reference(folder, folder / kReferenceFolder);
  }
  added.push_back(stayed(outcome));
  added.push_back(makes_sense(refused_));
  for (auto& check : safety_checks(folder, limits_of(fixture_.rig.parameters))) {
    added.push_back(std::move(check));
  }
  checks.insert(checks.begin(), added.begin(), added.end());
  judgement.verdict = worst_of(checks);
}

}  // namespace towbench::harness
