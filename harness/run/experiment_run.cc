#include "harness/run/experiment_run.h"

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/board_bench/board_truth.h"
#include "harness/fault_cases/case_link.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_cases/record_faults.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/link/emulator_process.h"
#include "harness/link/in_process_plant.h"
#include "harness/link/killed_host.h"
#include "harness/link/linked_plant.h"
#include "harness/link/pty_line.h"
#include "harness/link/wires.h"
#include "harness/link/witnessed_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/run_timing.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/record/can_log.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/message_record.h"
#include "harness/record/plant_recorder.h"
#include "harness/record/result_files.h"
#include "harness/record/run_folder.h"
#include "harness/run/board_run.h"
#include "harness/run/carrier_name.h"
#include "harness/run/driven_run.h"
#include "harness/run/late_link.h"
#include "harness/run/run_carrier.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/paced_can.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {
namespace {

class Run {
 public:
  Run(const ExperimentFixture& fixture, const RunOptions& options)
      // The analyzer loses sight of the unique_ptr that owns it.
      // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
      : faults_(faults_of(fixture, options)),
        fixture_(faults_ ? faults_->fixture() : fixture),
        options_(options) {
    if (options.firmware.empty()) {
      refuse_board_plan(fixture);
    } else {
      fixture_ = board_.emplace(fixture, options, seed_of(fixture, options)).fixture();
    }
    if (options.hand != nullptr) {
      given_ = fixture;
    }
    wire_ = options.wire;
    identity_.carrier = name_of_carrier(options);
    identity_.clock = options.clock == RunClock::kReal ? "real" : "lockstep";
    identity_.fidelity = fidelity_of(options);
    identity_.seed = seed_of(fixture, options);
    identity_.started_utc = utc_now();
    constexpr std::size_t kShortHash = 8;
    folder_ = create_run_folder(options.out, fixture.experiment.name,
                                hash_text(fixture.hash).substr(0, kShortHash));
    identity_.experiment_copy = copy_inputs(fixture.sources, folder_);
    write_started(folder_, fixture, identity_);
    if (options.tap != nullptr) {
      options.tap->begins(folder_);
    }
  }

  RunResult run() {
    auto outcome = faults_ && faults_->kills_host()          ? run_to_be_killed()
                   : options_.carrier == Carrier::kInProcess ? run_in_process()
                                                             : run_with_child();
    if (outcome.control_period_ns == 0) {  // a stranger's image has rows of another distance
      outcome.control_period_ns = fixture_.controller.configuration.control_period_ns();
    }
    outcome.complete = outcome.complete || (faults_ && faults_->may_end_run());
    if (options_.hand != nullptr) {
      take_over_what_was_done();
    }
    RunResult result;
    result.folder = folder_;
    result.complete = outcome.complete;
    result.reason = outcome.reason;
    if (outcome.complete) {
      if (board_) {
        board_->keep_twin(folder_);
      }
      merge_events(folder_);
      if (!faults_ || !faults_->kills_host()) {
        result.judgement = judge(folder_, fixture_, outcome);
      }
      if (board_) {
        board_->judge_into(folder_, result.judgement);
      }
      if (timing_) {
        result.timing = timing_->judge_into(result.judgement, outcome.control_period_ns);
      }
      if (faults_) {
        result.faults = faults_->judge_into(
            folder_,
            {.writes_succeeded = outcome.writes_succeeded, .host_was_killed = host_was_killed_},
            result.judgement);
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
  static std::unique_ptr<FaultedExperiment> faults_of(const ExperimentFixture& fixture,
                                                      const RunOptions& options) {
    if (!options.firmware.empty()) {
      return nullptr;  // firmware_faults.h
    }
    if (!fixture.experiment.faults.empty() && !options.encoder_lines.controller.empty()) {
      throw FixtureError({.file = "fault plan"}, "a run with its encoders on lines",
                         "encoders over the carrier: a fault is judged beside a twin of the same "
                         "bits");
    }
    if (!fixture.experiment.faults.empty() && options.clock == RunClock::kReal) {
      throw FixtureError({.file = "fault plan"}, "a run by the wall clock",
                         "lockstep: a fault is judged beside a twin of the same bits");
    }
    return fixture.experiment.faults.empty()
               ? nullptr
               : std::make_unique<FaultedExperiment>(fixture, seed_of(fixture, options),
                                                     kind_of(options));
  }

  RunOutcome run_in_process() {
    PlantRecorder plant_recorder(folder_, options_.tap);
    BoardTruth board_truth(plant_recorder);
    emulator::PlantObserver& observer = plant_recorder;
    InProcessPlant plant(fixture_.rig.parameters, identity_.seed, fixture_.experiment.events,
                         board_ ? board_truth : observer);
    auto outcome = !board_ ? play_against(plant, plant) : board_->play(folder_, plant, board_truth);
    plant_recorder.flush();
    outcome.writes_succeeded = outcome.writes_succeeded && plant_recorder.good();
    return outcome;
  }

  RunOutcome run_to_be_killed() {
    host_was_killed_ = run_until_killed([this] { (void)run_with_child(); });
    RunOutcome outcome;
    outcome.complete = true;
    outcome.reason = host_was_killed_ ? "the controller's process was killed" : "";
    return outcome;
  }

  RunOutcome run_with_child() {
    std::vector<std::string> arguments{(folder_ / identity_.experiment_copy).string(), "--seed",
                                       std::to_string(identity_.seed), "--out", folder_.string()};
    if (!options_.lines.plant.empty()) {
      arguments.insert(arguments.end(), {"--lines", options_.lines.plant});
    }
    if (!options_.encoder_lines.plant.empty()) {
      arguments.insert(arguments.end(), {"--encoder-lines", options_.encoder_lines.plant});
    }
    if (options_.clock == RunClock::kReal) {
      arguments.insert(arguments.end(), {"--clock", "real"});
    }
    std::optional<PtyLine> line;
    if (options_.carrier == Carrier::kSerialPty) {
      line.emplace();
      const auto ends =
          protocol::parse_carrier_ends("serial:" + line->near_end() + ',' + line->far_end());
      wire_ = *ends;
    }
    // What it has to say of such an end is in its record.
    const bool end_is_expected = faults_ && (faults_->may_end_run() || faults_->kills_host());
    const auto child =
        options_.carrier == Carrier::kLocal
            ? EmulatorProcess::with_socket(options_.program, arguments, end_is_expected)
            : EmulatorProcess::on_wire(options_.program, arguments, wire_->plant.text(),
                                       end_is_expected);
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
    if (wire_) {
      connection = Connection::to_plant(wire_->controller, kStartUp_ns);
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
      log = std::make_unique<CanLog>(folder_ / "candump.log",
                                     protocol::named_bus(wire_->controller.place)->interface);
      can->log_to(*log);
    }
    auto outcome = options_.clock == RunClock::kReal
                       ? play_in_real_time(child, **connection, log.get())
                       : play_in_lockstep(child, (*connection)->link());
    write_wire_use((*connection)->wire_use());
    if (log != nullptr) {
      log->flush();
      outcome.writes_succeeded = outcome.writes_succeeded && log->good();
    }
    return outcome;
  }

  // What this run has put on its wire, for whoever compares carriers.
  void write_wire_use(const protocol::WireUse& use) const {
    const nlohmann::json bits{{"bits_to_plant", use.bits_sent},
                              {"bits_to_controller", use.bits_received}};
    write_atomically(folder_ / "wire.json", bits.dump(1) + "\n");
  }

  RunOutcome play_in_lockstep(PeerControl& peer, protocol::TurnLink& link) {
    LinkedPlant plant(link);
    return with_lines(plant, EdgeTimes::kOfExchange,
                      [&](PlantEnd& whole) { return play_against(whole, peer); });
  }

  // `play` with the plant, or with the plant and the real lines of the run.
  template <typename Play>
  RunOutcome with_lines(PlantEnd& plant, EdgeTimes times, Play play) {
    const auto wired = WiredPlant::open(
        plant, {options_.lines.controller, options_.encoder_lines.controller}, times);
    if (!wired) {
      RunOutcome outcome;
      outcome.reason = wired.error().message;
      return outcome;
    }
    return play((*wired)->whole());
  }

  // `log` may be null.
  RunOutcome play_in_real_time(PeerControl& peer, protocol::Connection& connection, CanLog* log) {
    MessageRecord heard(folder_ / kControllerInputsFile);
    CanLogClock log_clock(log);
    protocol::TeeSink witness(log_clock, heard.sink());
    go_by_the_wall_clock(connection);
    timing_.emplace(folder_, fixture_.controller.configuration);
    RealtimePlantEnd timed(connection.link(), timing_->loop(), takes_edges(options_));
    auto outcome = with_lines(timed, EdgeTimes::kOfKernel, [&](PlantEnd& whole) {
      WitnessedPlant plant(whole, witness);
      return play_against(plant, peer);
    });
    heard.flush();
    outcome.writes_succeeded = outcome.writes_succeeded && heard.good();
    return outcome;
  }

  RunOutcome play_against(PlantEnd& plant, PeerControl& peer) {
    ControllerRecorder recorder(folder_, options_.tap);
    // By the wall clock a hand only types: there is nothing to disturb between the two.
    if (!faults_ && (options_.hand == nullptr || options_.clock == RunClock::kReal)) {
      return watched(plant, [&](PlantEnd& whole) {
        LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, whole, &recorder);
        return play(fixture_.experiment, bench, recorder, options_.watchers, options_.hand);
      });
    }
    if (!faults_) {
      LateLink link(plant, peer);
      return play_on(link, {}, recorder);
    }
    CaseRecord crossed;  // what it notes is of no use here: the judge makes its own
    const Injection planned = faults_->injection();
    CaseLink link(plant, peer, planned.link, crossed);
    RecordFaults of_record(planned.host, folder_, recorder);
    link.tell(of_record);
    return play_on(link, planned.host, recorder);
  }

  RunOutcome play_on(PlantEnd& link, const HostSchedule& host, ControllerRecorder& recorder) {
    return watched(link, [&](PlantEnd& whole) {
      LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, whole, &recorder);
      bench.run_on(host);
      return play(fixture_.experiment, bench, recorder, options_.watchers, options_.hand);
    });
  }

  // `play` with the plant, with whoever looks on listening to it.
  template <typename Play>
  RunOutcome watched(PlantEnd& plant, Play play) {
    auto* const witness = options_.tap != nullptr ? options_.tap->witness() : nullptr;
    if (witness == nullptr) {
      return play(plant);
    }
    WitnessedPlant heard(plant, *witness);
    return play(heard);
  }

  std::unique_ptr<FaultedExperiment> faults_;  // null: a sound machine, or an image on the board
  std::optional<BoardRun> board_;              // an image on the virtual board
  ExperimentFixture given_;                    // with a hand: before anything was planned or done
  ExperimentFixture fixture_;
  const RunOptions& options_;
  RunIdentity identity_;
  std::filesystem::path folder_;
  std::optional<protocol::CarrierEnds> wire_;  // empty: a socket, or nothing between
  bool host_was_killed_ = false;
  std::optional<ControllerTiming> timing_;  // of a run in real time
};

}  // namespace

RunResult run_experiment(const ExperimentFixture& fixture, const RunOptions& options) {
  return Run(fixture, options).run();
}

}  // namespace towbench::harness
