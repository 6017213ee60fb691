#include "harness/board_bench/firmware_run.h"

#include <chrono>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "board/board.h"
#include "harness/board_bench/board_budgets.h"
#include "harness/board_bench/board_faults.h"
#include "harness/board_bench/board_report.h"
#include "harness/board_bench/firmware_bench.h"
#include "harness/board_bench/firmware_terminal.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/lockstep/console_script.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/firmware_recorder.h"

namespace towbench::harness {
namespace {

board::ElfImage read_image(const std::filesystem::path& file) {
  auto image = board::ElfImage::read(file.string());
  if (!image) {
    throw FixtureError({file.string(), 0, "firmware"}, image.error(),
                       "an ELF executable for a bare-metal AM335x");
  }
  return std::move(*image);
}

void load(board::Board& board, const std::filesystem::path& file) {
  if (const auto refusal = board.load(read_image(file)); !refusal.empty()) {
    throw FixtureError({file.string(), 0, "firmware"}, refusal,
                       "an image that lies in the board's memory");
  }
}

std::uint8_t axes_of(const emulator::RigParameters& rig) {
  unsigned mask = 0;
  for (const core::Axis axis : core::kPlanarAxes) {
    mask |= rig.axes[axis].exists ? 1U << core::index_of(axis) : 0U;
  }
  return static_cast<std::uint8_t>(mask);
}

// The script on the board, as script_loop.cc plays it on the other benches, and one more end: an
// image that cannot go on.
class FirmwareLoop {
 public:
  // `person` may be null.
  FirmwareLoop(const ExperimentFixture& fixture, FirmwareBench& bench, FirmwareRecorder& recorder,
               const LoopWatchers& watchers, BoardFaults& faults, FirmwareTerminal* person)
      : fixture_(fixture),
        bench_(bench),
        recorder_(recorder),
        watchers_(watchers),
        faults_(faults),
        person_(person),
        script_(person == nullptr ? fixture.experiment.console : std::vector<ConsoleStep>{}),
        limit_ns_(core::nanoseconds(fixture.experiment.duration_limit_s)) {}

  RunOutcome run() {
    const auto start = HostClock::now();
    start_ = start;
    if (const auto agreed = bench_.start(); !agreed) {
      outcome_.reason = "handshake refused: " + std::string(core::describe(agreed.error()));
    } else {
      exchange_until_over(start);
    }
    outcome_.wall_time_s = core::seconds(since(start));
    outcome_.end_ns = bench_.now_ns();
    outcome_.rows_lost = bench_.rows_lost();
    return outcome_;
  }

 private:
  using HostClock = std::chrono::steady_clock;

  static core::Nanoseconds since(HostClock::time_point start) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(HostClock::now() - start).count();
  }

  void exchange_until_over(HostClock::time_point start) {
    constexpr std::uint32_t kExchangesBetween = 4096;
    core::Nanoseconds last_host_ns = since(start);
    for (std::uint32_t exchanges = 1; !turn_is_last(); ++exchanges) {
      if (const auto alive = bench_.advance(); !alive) {
        outcome_.reason = "the emulator was lost: " + std::string(core::describe(alive.error()));
        return;
      }
      if (bench_.now_ns() % FirmwareBench::kPinRow_ns == 0) {
        const core::Nanoseconds host_ns = since(start);
        recorder_.timing(bench_.now_ns(), host_ns, host_ns - last_host_ns);
        last_host_ns = host_ns;
      }
      if (watchers_.progress && exchanges % kExchangesBetween == 0) {
        watchers_.progress(bench_.now_ns());
      }
    }
    bench_.finish();
  }

  void note_typed(core::Nanoseconds now_ns, std::string_view typed) {
    if (!typed.empty()) {
      outcome_.typed_ns.push_back(now_ns);
    }
  }

  // Types what a person has typed, and waits for the wall clock.
  void serve_person(core::Nanoseconds now_ns, std::string_view printed) {
    constexpr core::Nanoseconds kPace_ns = 5 * core::kNanosecondsPerMillisecond;
    shown_ += printed;
    if (now_ns % kPace_ns == 0) {
      const auto typed = person_->exchange(shown_);
      bench_.type(typed);
      note_typed(now_ns, typed);
      shown_.clear();
      std::this_thread::sleep_until(start_ + std::chrono::nanoseconds(now_ns));
    }
  }

  void act_on_board(core::Nanoseconds now_ns) {
    const bool by_watchdog = bench_.watchdog_resets() != watchdog_resets_;
    if (by_watchdog) {
      watchdog_resets_ = bench_.watchdog_resets();
      recorder_.wire_event(now_ns, "watchdog_reset");
    }
    if (faults_.act(now_ns) || by_watchdog) {
      bench_.restarted();
      outcome_.restarted_ns.push_back(now_ns);
      if (bench_.probe().has_port()) {
        static_cast<void>(bench_.probe().set_parameters(
            fixture_.controller.configuration));  // they fitted before
      }
    }
  }

  bool turn_is_last() {
    if (script_over_ns_ < 0) {
      if (!script_ends()) {
        return false;
      }
      script_over_ns_ = bench_.now_ns();
    } else {
      act_on_board(bench_.now_ns());
      bench_.serve();
    }
    return !outcome_.complete || person_ != nullptr || !bench_.failure().empty() || settled();
  }

  // As script_loop.cc has it. Whether a third-party image is idle nobody knows.
  bool settled() {
    const auto& experiment = fixture_.experiment;
    const bool sound = experiment.faults.empty() && experiment.board.faults.empty();
    const auto waited_ns = bench_.now_ns() - script_over_ns_;
    if (bench_.now_ns() % FirmwareBench::kPinRow_ns != 0) {
      return false;  // a record ends with a whole row
    }
    return (sound && bench_.probe().has_port() && bench_.idle()) ||
           bench_.undriven_ns() >= kCoasting_ns || waited_ns >= kLongestSettling_ns;
  }

  bool script_ends() {
    const auto now_ns = bench_.now_ns();
    act_on_board(now_ns);
    // Bytes that come while the image still sets up its UART would be lost, as on a bench.
    if (bench_.listens()) {
      const auto pending = script_.pending(now_ns);
      bench_.type(pending);
      script_.typed(pending.size());
      note_typed(now_ns, pending);
    }
    const auto printed = bench_.serve();
    script_.hear(printed);
    if (person_ != nullptr) {
      serve_person(now_ns, printed);
    }
    const auto progress = person_ == nullptr ? script_.update(now_ns, bench_.idle())
                                             : ConsoleScript::Progress::kRunning;
    if (watchers_.stop != nullptr && watchers_.stop->load(std::memory_order_relaxed)) {
      if (person_ == nullptr) {
        outcome_.reason = "interrupted";
        return true;
      }
      // That is how a person ends a run; a record ends with a whole row.
      outcome_.complete = now_ns % FirmwareBench::kPinRow_ns == 0;
      return outcome_.complete;
    }
    const bool running = progress == ConsoleScript::Progress::kRunning;
    const auto failure = bench_.failure();
    if (running && now_ns < limit_ns_ && failure.empty()) {
      return false;
    }
    outcome_.complete = true;
    if (person_ != nullptr && failure.empty()) {
      return true;
    }
    outcome_.script_failure = script_.failure();
    if (!failure.empty()) {
      outcome_.script_failure =
          fmt::format("at {:.4f} s, in step {} of {}: {}", core::seconds(now_ns),
                      script_.steps_done() + 1, script_.steps(), failure);
    } else if (running) {
      outcome_.script_failure =
          fmt::format("the time limit of {} s came in step {} of {}; it had not ended",
                      core::seconds(limit_ns_), script_.steps_done() + 1, script_.steps());
    }
    return true;
  }

  const ExperimentFixture& fixture_;
  FirmwareBench& bench_;
  FirmwareRecorder& recorder_;
  const LoopWatchers& watchers_;
  BoardFaults& faults_;
  FirmwareTerminal* person_;
  HostClock::time_point start_;
  std::string shown_;
  core::Nanoseconds script_over_ns_ = -1;
  unsigned watchdog_resets_ = 0;
  ConsoleScript script_;
  core::Nanoseconds limit_ns_;
  RunOutcome outcome_;
};

// With a fault it may be the right thing to do.
Check reset_by_watchdog(unsigned resets) {
  Check check;
  check.name = "no_watchdog_reset";
  check.meaning = "the image serves the watchdog that it has started";
  check.verdict = Verdict::kFail;
  check.value = resets;
  check.max = 0;
  check.reason = fmt::format("the watchdog has reset the board {} times", resets);
  return check;
}

// As a run of the project's own controller keeps it. An image that is switched off and on starts
// its clock, and with it its rows, at any time: then every row is kept.
core::Nanoseconds truth_period_ns(const ExperimentFixture& fixture, bool has_port) {
  if (!fixture.experiment.board.faults.empty()) {
    return core::kPlantTick_ns;
  }
  return has_port ? bbmc::exchange_period_ns(fixture.controller.configuration.control_period_ns())
                  : FirmwareBench::kPinRow_ns;
}

}  // namespace

void check_firmware(const std::filesystem::path& image) {
  board::Board board;
  load(board, image);
}

RunOutcome run_firmware(const ExperimentFixture& fixture, const FirmwareOptions& options,
                        const std::filesystem::path& folder, const FirmwareMachine& machine,
                        const LoopWatchers& watchers, std::vector<Check>& checks) {
  board::Board board;
  load(board, options.image);
  DebugProbe probe(board);
  if (probe.has_port()) {
    if (const auto why = probe.set_parameters(fixture.controller.configuration); !why.empty()) {
      RunOutcome refused;
      refused.reason = why;
      return refused;
    }
  }
  using Log = FirmwareRecorder::Log;
  FirmwareRecorder recorder(folder, probe.has_port() ? Log::kTelemetry : Log::kPins);
  machine.truth.keep_every(truth_period_ns(fixture, probe.has_port()));
  FirmwareBench bench(board, fixture.experiment.board.wiring, axes_of(fixture.rig.parameters),
                      fixture.rig.hash, machine, recorder);
  BoardFaults faults(fixture.experiment.board.faults, board);
  std::optional<FirmwareTerminal> person;
  if (options.person_at_console) {
    person.emplace();
    if (watchers.terminal) {
      watchers.terminal(person->path());
    }
  }
  auto outcome =
      FirmwareLoop(fixture, bench, recorder, watchers, faults, person ? &*person : nullptr).run();
  machine.truth.finish();
  outcome.exchange_ns = machine.truth.period_ns();
  checks = faults.checks();
  const auto& experiment = fixture.experiment;
  if (board.watchdog_resets() > 0 && experiment.faults.empty() && experiment.board.faults.empty()) {
    checks.push_back(reset_by_watchdog(board.watchdog_resets()));
  }
  if (!board.doubt().empty()) {
    checks.push_back(invalid_check("registers_modelled",
                                   "no register that is merely kept decides what the image does",
                                   board.doubt()));
  }
  for (Check& check : board_budget_checks(fixture.experiment.board.budgets, board, bench.probe())) {
    checks.push_back(std::move(check));
  }
  recorder.flush();
  outcome.log_rows = recorder.rows();
  outcome.writes_succeeded = recorder.good();
  if (!probe.has_port()) {
    outcome.control_period_ns = FirmwareBench::kPinRow_ns;
  }
  outcome.writes_succeeded =
      write_board_report(folder / "board.json", board, bench.probe()) && outcome.writes_succeeded;
  return outcome;
}

}  // namespace towbench::harness
