#include "harness/bench/experiment_run.h"

#include <memory>
#include <string>
#include <vector>

#include "harness/bench/driven_run.h"
#include "harness/bench/emulator_process.h"
#include "harness/bench/firmware_run.h"
#include "harness/bench/in_process_plant.h"
#include "harness/bench/linked_plant.h"
#include "harness/bench/lockstep_bench.h"
#include "harness/bench/real_lines.h"
#include "harness/faults/case_link.h"
#include "harness/faults/faulted_experiment.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/run_timing.h"
#include "harness/record/can_log.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/plant_recorder.h"
#include "harness/record/result_files.h"
#include "harness/record/run_folder.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/line_address.h"

namespace towbench::harness {
namespace {

class Run {
 public:
  Run(const ExperimentFixture& fixture, const RunOptions& options)
      : faults_(faults_of(fixture, options)),
        fixture_(faults_ ? faults_->fixture() : fixture),
        options_(options) {
    if (options.hand != nullptr) {
      given_ = fixture;
    }
    identity_.carrier = name_of_carrier(options);
    identity_.clock = options.clock == RunClock::kReal ? "real" : "lockstep";
    identity_.fidelity = is_bus(options) ? "digest" : "edges";
    identity_.seed = seed_of(fixture, options);
    identity_.started_utc = utc_now();
    constexpr std::size_t kShortHash = 8;
    folder_ = create_run_folder(options.out, fixture.experiment.name,
                                hash_text(fixture.hash).substr(0, kShortHash));
    identity_.experiment_copy = copy_inputs(fixture.sources, folder_);
    write_started(folder_, fixture, identity_);
  }

  RunResult run() {
    auto outcome = options_.carrier == Carrier::kInProcess ? run_in_process() : run_with_child();
    if (outcome.control_period_ns == 0) {  // a stranger's image has rows of another distance
      outcome.control_period_ns = fixture_.controller.configuration.control_period_ns();
    }
    outcome.complete = outcome.complete || (faults_ && faults_->kills_plant());
    if (options_.hand != nullptr) {
      take_over_what_was_done();
    }
    RunResult result;
    result.folder = folder_;
    result.complete = outcome.complete;
    result.reason = outcome.reason;
    if (outcome.complete) {
      merge_events(folder_);
      result.judgement = judge(folder_, fixture_, outcome);
      if (timing_) {
        result.timing = timing_->judge_into(result.judgement, outcome.control_period_ns);
      }
      if (faults_) {
        faults_->judge_into(folder_, result.judgement);
      }
      write_judged(folder_, fixture_, identity_, outcome, result.judgement);
      result.exit_code = exit_code_of(result.judgement.verdict);
    } else {
      write_incomplete(folder_, fixture_, identity_, outcome);
    }
    result.outcome = outcome;
    return result;
  }

 private:
  // From here on the experiment is the one that was driven, with what was broken by hand.
  void take_over_what_was_done() {
    auto driven = as_driven(
        given_, faults_ ? faults_->onsets_ns() : std::vector<core::Nanoseconds>{}, *options_.hand);
    if (driven.experiment.hand.empty()) {
      return;
    }
    write_atomically(folder_ / identity_.experiment_copy, driven.sources.front().text);
    if (driven.experiment.faults.empty()) {
      fixture_ = std::move(driven);
    } else {
      faults_ = std::make_unique<FaultedExperiment>(driven, identity_.seed);
      fixture_ = faults_->fixture();
    }
  }

  static std::uint64_t seed_of(const ExperimentFixture& fixture, const RunOptions& options) {
    return options.seed.value_or(fixture.experiment.seed);
  }
  static std::string name_of_carrier(const RunOptions& options) {
    const auto lines = options.lines.controller.empty() ? "" : " and " + options.lines.controller;
    switch (options.carrier) {
      case Carrier::kInProcess:
        return options.firmware.empty() ? "in-process" : "virtual board";
      case Carrier::kLocal:
        return "local" + lines;
      case Carrier::kWire:
        break;
    }
    return options.wire->controller.text() + lines;
  }
  static bool is_bus(const RunOptions& options) {
    return options.carrier == Carrier::kWire &&
           options.wire->controller.scheme == protocol::Scheme::kCan;
  }
  static std::unique_ptr<FaultedExperiment> faults_of(const ExperimentFixture& fixture,
                                                      const RunOptions& options) {
    return fixture.experiment.faults.empty()
               ? nullptr
               : std::make_unique<FaultedExperiment>(fixture, seed_of(fixture, options));
  }

  RunOutcome run_in_process() {
    PlantRecorder plant_recorder(folder_, options_.tap);
    InProcessPlant plant(fixture_.rig.parameters, identity_.seed, fixture_.experiment.events,
                         plant_recorder);
    auto outcome = options_.firmware.empty() ? play_against(plant) : play_firmware(plant);
    plant_recorder.flush();
    outcome.writes_succeeded = outcome.writes_succeeded && plant_recorder.good();
    return outcome;
  }

  RunOutcome run_with_child() {
    std::vector<std::string> arguments{(folder_ / identity_.experiment_copy).string(), "--seed",
                                       std::to_string(identity_.seed), "--out", folder_.string()};
    if (!options_.lines.plant.empty()) {
      arguments.insert(arguments.end(), {"--lines", options_.lines.plant});
    }
    if (options_.clock == RunClock::kReal) {
      arguments.insert(arguments.end(), {"--clock", "real"});
    }
    const auto child =
        options_.carrier == Carrier::kLocal
            ? EmulatorProcess::with_socket(options_.program, arguments)
            : EmulatorProcess::on_wire(options_.program, arguments, options_.wire->plant.text());
    auto outcome = play_over(*child);
    if (const auto trouble = child->join(); !trouble.empty()) {
      outcome.reason += (outcome.reason.empty() ? "" : "; ") + trouble;
      outcome.complete = false;
    }
    return outcome;
  }

  RunOutcome play_over(EmulatorProcess& child) {
    using protocol::Connection;
    protocol::CarrierResult<std::unique_ptr<Connection>> connection;
    constexpr core::Nanoseconds kStartUp_ns = 10 * core::kNanosecondsPerSecond;
    if (options_.carrier == Carrier::kWire) {
      connection = Connection::to_plant(options_.wire->controller, kStartUp_ns);
    } else {
      connection = Connection::over(child.take_stream());
      // A child that died shows in the handshake.
      (void)(*connection)->await_heartbeat(kStartUp_ns);
    }
    if (!connection) {
      RunOutcome outcome;
      outcome.reason = connection.error().message;
      return outcome;
    }
    std::unique_ptr<CanLog> log;
    if (auto* can = (*connection)->can_link(); can != nullptr) {
      log = std::make_unique<CanLog>(folder_ / "candump.log", options_.wire->controller.place);
      can->log_to(*log);
    }
    auto outcome = options_.clock == RunClock::kReal ? play_in_real_time((*connection)->link())
                                                     : play_in_lockstep((*connection)->link());
    if (log != nullptr) {
      log->flush();
      outcome.writes_succeeded = outcome.writes_succeeded && log->good();
    }
    return outcome;
  }

  RunOutcome play_in_lockstep(protocol::TurnLink& link) {
    LinkedPlant plant(link);
    if (options_.lines.controller.empty()) {
      return play_against(plant);
    }
    const auto port =
        protocol::open_lines(options_.lines.controller, protocol::LineSide::kController);
    if (!port) {
      RunOutcome outcome;
      outcome.reason = port.error().message;
      return outcome;
    }
    RealLinesAtController with_lines(plant, **port);
    return play_against(with_lines);
  }

  RunOutcome play_in_real_time(protocol::TurnLink& link) {
    timing_.emplace(folder_, fixture_.controller.configuration);
    RealtimePlantEnd plant(link, timing_->loop());
    return play_against(plant);
  }

  RunOutcome play_firmware(PlantEnd& plant) {
    return run_firmware(fixture_, options_.firmware, folder_, plant, options_.watchers);
  }

  RunOutcome play_against(PlantEnd& plant) {
    ControllerRecorder recorder(folder_, options_.tap);
    if (!faults_ && options_.hand == nullptr) {
      LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, plant, &recorder);
      return play(fixture_.experiment, bench, recorder, options_.watchers);
    }
    CaseRecord crossed;  // what it notes is of no use here: the judge makes its own
    const Injection planned = faults_ ? faults_->injection() : Injection{};
    CaseLink link(plant, planned.link, crossed);
    LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, link, &recorder);
    bench.run_on(planned.host);
    return play(fixture_.experiment, bench, recorder, options_.watchers, options_.hand);
  }

  std::unique_ptr<FaultedExperiment> faults_;  // null: a sound machine
  ExperimentFixture given_;                    // with a hand: before anything was planned or done
  ExperimentFixture fixture_;
  const RunOptions& options_;
  RunIdentity identity_;
  std::filesystem::path folder_;
  std::optional<ControllerTiming> timing_;  // of a run in real time
};

}  // namespace

RunResult run_experiment(const ExperimentFixture& fixture, const RunOptions& options) {
  return Run(fixture, options).run();
}

}  // namespace towbench::harness
