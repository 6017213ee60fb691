#include "harness/bench/firmware_run.h"

#include <chrono>

#include <fmt/format.h>

#include "board/board.h"
#include "harness/bench/board_report.h"
#include "harness/bench/console_script.h"
#include "harness/bench/firmware_bench.h"
#include "harness/fixtures/fixture_error.h"
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
  for (const core::Axis axis : core::kAxes) {
    mask |= rig.axes[axis].exists ? 1U << core::index_of(axis) : 0U;
  }
  return static_cast<std::uint8_t>(mask);
}

// The script on the board, as script_loop.cc plays it on the other benches, and one more end: an
// image that cannot go on.
class FirmwareLoop {
 public:
  FirmwareLoop(const Experiment& experiment, FirmwareBench& bench, FirmwareRecorder& recorder,
               const LoopWatchers& watchers)
      : bench_(bench),
        recorder_(recorder),
        watchers_(watchers),
        script_(experiment.console),
        limit_ns_(core::nanoseconds(experiment.duration_limit_s)) {}

  RunOutcome run() {
    const auto start = HostClock::now();
    if (const auto agreed = bench_.start(); !agreed) {
      outcome_.reason = "handshake refused: " + std::string(core::describe(agreed.error()));
    } else {
      exchange_until_over(start);
    }
    outcome_.wall_time_s = core::seconds(since(start));
    outcome_.end_ns = bench_.now_ns();
    outcome_.exchange_ns = core::kPlantTick_ns;
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
      const core::Nanoseconds host_ns = since(start);
      recorder_.timing(bench_.now_ns(), host_ns, host_ns - last_host_ns);
      last_host_ns = host_ns;
      if (watchers_.progress && exchanges % kExchangesBetween == 0) {
        watchers_.progress(bench_.now_ns());
      }
    }
    bench_.finish();
  }

  bool turn_is_last() {
    const auto now_ns = bench_.now_ns();
    // Bytes that come while the image still sets up its UART would be lost, as on a bench.
    if (bench_.listens()) {
      const auto pending = script_.pending(now_ns);
      bench_.type(pending);
      script_.typed(pending.size());
    }
    script_.hear(bench_.serve());
    const auto progress = script_.update(now_ns, bench_.idle());
    if (watchers_.stop != nullptr && watchers_.stop->load(std::memory_order_relaxed)) {
      outcome_.reason = "interrupted";
      return true;
    }
    const bool running = progress == ConsoleScript::Progress::kRunning;
    const auto failure = bench_.failure();
    if (running && now_ns < limit_ns_ && failure.empty()) {
      return false;
    }
    outcome_.complete = true;
    outcome_.script_failure = script_.failure();
    if (!failure.empty()) {
      outcome_.script_failure = fmt::format("at {} s, in step {} of {}: {}", core::seconds(now_ns),
                                            script_.steps_done() + 1, script_.steps(), failure);
    } else if (running) {
      outcome_.script_failure =
          fmt::format("the time limit of {} s came in step {} of {}; it had not ended",
                      core::seconds(limit_ns_), script_.steps_done() + 1, script_.steps());
    }
    return true;
  }

  FirmwareBench& bench_;
  FirmwareRecorder& recorder_;
  const LoopWatchers& watchers_;
  ConsoleScript script_;
  core::Nanoseconds limit_ns_;
  RunOutcome outcome_;
};

}  // namespace

void check_firmware(const std::filesystem::path& image) {
  board::Board board;
  load(board, image);
}

RunOutcome run_firmware(const ExperimentFixture& fixture, const std::filesystem::path& image,
                        const std::filesystem::path& folder, PlantEnd& plant,
                        const LoopWatchers& watchers) {
  board::Board board;
  load(board, image);
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
  const BoardWiring wiring;
  FirmwareBench bench(board, wiring, axes_of(fixture.rig.parameters), fixture.rig.hash, plant,
                      recorder);
  auto outcome = FirmwareLoop(fixture.experiment, bench, recorder, watchers).run();
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
