// Whole runs by the wall clock over each kind of carrier, in a time that both sides share instead
// of the host's: the same every time, as fast as it goes, and replayed to the last bit.
#include <optional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/link/encoder_lines.h"
#include "harness/link/real_lines.h"
#include "harness/link/witnessed_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/message_record.h"
#include "harness/record/plant_recorder.h"
#include "harness/run/wall_clock_replay.h"
#include "protocol/carriers/can_link.h"
#include "protocol/carriers/lockstep_link.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/harness/realtime/shared_time.h"
#include "tests/protocol/edges_in_memory.h"

namespace towbench::harness {
namespace {

using protocol::Scheme;

// What stands between two threads: bytes or frames, and lines.
struct Wire {
  SharedTime time;
  SharedQueue<std::byte> bytes_to_plant{time, Who::kPlant};
  SharedQueue<std::byte> bytes_to_controller{time, Who::kController};
  SharedQueue<protocol::CanFrame> frames_to_plant{time, Who::kPlant};
  SharedQueue<protocol::CanFrame> frames_to_controller{time, Who::kController};
  protocol::EdgesInMemory encoders{[this] { return time.now_ns(); }};
};

class End {
 public:
  End(Wire& wire, Scheme scheme, Who who)
      : stream_(who == Who::kPlant ? wire.bytes_to_controller : wire.bytes_to_plant,
                who == Who::kPlant ? wire.bytes_to_plant : wire.bytes_to_controller),
        bus_(who == Who::kPlant ? wire.frames_to_controller : wire.frames_to_plant,
             who == Who::kPlant ? wire.frames_to_plant : wire.frames_to_controller) {
    if (scheme == Scheme::kCan) {
      auto link = std::make_unique<protocol::CanLink>(
          bus_, who == Who::kPlant ? protocol::CanDirection::kToController
                                   : protocol::CanDirection::kToPlant);
      link->go_by_the_wall_clock();
      can_ = link.get();
      link_ = std::move(link);
    } else if (scheme == Scheme::kSerial) {
      link_ = std::make_unique<protocol::SerialLockstepLink>(stream_);
    } else {
      link_ = std::make_unique<protocol::LockstepLink>(stream_);
    }
  }
  [[nodiscard]] protocol::TurnLink& link() { return *link_; }
  [[nodiscard]] const protocol::CanLink& can() const { return *can_; }

 private:
  SharedStream stream_;
  SharedBus bus_;
  protocol::CanLink* can_ = nullptr;
  std::unique_ptr<protocol::TurnLink> link_;
};

// Lines that one side drives and the other reads.
class LinesInMemory {
 public:
  class Port final : public protocol::LinePort {
   public:
    Port(LinesInMemory& lines, Who who) : lines_(lines), who_(who) {}
    core::Result<protocol::LineLevels> read() noexcept override {
      const std::lock_guard lock(lines_.mutex_);
      return protocol::LineLevels{.lines = who_ == Who::kPlant ? lines_.outputs_ : lines_.inputs_};
    }
    core::Status write(std::uint16_t lines) noexcept override {
      const std::lock_guard lock(lines_.mutex_);
      (who_ == Who::kPlant ? lines_.inputs_ : lines_.outputs_) = lines;
      return {};
    }

   private:
    LinesInMemory& lines_;
    Who who_;
  };

 private:
  std::mutex mutex_;
  std::uint16_t inputs_ = 0;
  std::uint16_t outputs_ = 0;
};

struct HelloWatch final : protocol::MessageSink {
  using MessageSink::on;
  void on(const protocol::Hello& message) noexcept override { hello = message; }
  std::optional<protocol::Hello> hello;
};

struct WallClockRun {
  RunOutcome outcome;
  core::Status plant;
  std::uint64_t frames_sent = 0;  // by the controller, over CAN
};

struct Carried {
  const char* name;
  Scheme scheme;
  bool real_lines;
  bool encoder_lines = false;
};

class WallClockRunTest : public testing::TestWithParam<Carried> {
 protected:
  [[nodiscard]] core::Nanoseconds exchange_ns() const {
    return bbmc::exchange_period_ns(fixture_.controller.configuration.control_period_ns());
  }
  core::Status serve_plant(Wire& wire, LinesInMemory& lines) {
    const Carried carried = GetParam();
    SharedClock clock(wire.time, Who::kPlant);
    End end(wire, carried.scheme, Who::kPlant);
    HelloWatch watch;
    while (!watch.hello) {
      if (!end.link().listen(watch, 1)) {
        return core::failure(core::ErrorCode::kPeerSilent);
      }
    }
    PlantRecorder recorder(folder(), fixture_.rig.parameters);
    ThinnedTruth thinned(recorder, exchange_ns());
    emulator::PlantNode plant(fixture_.rig.parameters, 1, fixture_.experiment.events, thinned);
    MessageRecord heard(folder() / kPlantInputsFile);
    LinesInMemory::Port port(lines, Who::kPlant);
    const auto loop = std::make_unique<TickLoop>(clock, TickPolicy{});
    const auto ended = serve_plant_in_real_time(
        plant, end.link(), *watch.hello, *loop,
        {.wires = {.lines = carried.real_lines ? &port : nullptr,
                   .encoders = carried.encoder_lines ? &wire.encoders.driver() : nullptr},
         .report_ns = report_period_ns(carried.scheme, watch.hello->exchange_ns),
         .witness = &heard.sink()});
    heard.flush();
    recorder.flush();
    EXPECT_EQ(loop->record().overruns, 0U) << "nobody is late in this time";
    wire.time.leave(Who::kPlant);
    return ended;
  }
  WallClockRun run() {
    const Carried carried = GetParam();
    Wire wire;
    LinesInMemory lines;
    WallClockRun result;
    std::thread plant_thread([&] { result.plant = serve_plant(wire, lines); });
    {
      SharedClock clock(wire.time, Who::kController);
      End end(wire, carried.scheme, Who::kController);
      const auto loop = std::make_unique<TickLoop>(clock, TickPolicy{.period_ns = exchange_ns()});
      RealtimePlantEnd timed(end.link(), *loop, bears_every_tick(carried.scheme));
      LinesInMemory::Port port(lines, Who::kController);
      std::optional<RealLinesAtController> lined;
      PlantEnd& with_lines =
          carried.real_lines ? static_cast<PlantEnd&>(lined.emplace(timed, port)) : timed;
      std::optional<EncoderLinesAtController> counted;
      PlantEnd& whole = carried.encoder_lines
                            ? static_cast<PlantEnd&>(counted.emplace(
                                  with_lines, wire.encoders.reader(), EdgeTimes::kOfKernel))
                            : with_lines;
      MessageRecord heard(folder() / kControllerInputsFile);
      WitnessedPlant plant(whole, heard.sink());
      ControllerRecorder recorder(folder());
      LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, plant, &recorder);
      result.outcome = play(fixture_.experiment, bench, recorder, {});
      heard.flush();
      if (carried.scheme == Scheme::kCan) {
        result.frames_sent = end.can().frames_sent();
      }
      wire.time.leave(Who::kController);
    }
    plant_thread.join();
    merge_events(folder());
    return result;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return files_.folder(); }

  TemporaryFixtures files_;
  ExperimentFixture fixture_ = Runs::shipped("wall-clock-window");
};

TEST_P(WallClockRunTest, MovesTheMachineAndReplaysToTheLastBit) {
  const auto run = WallClockRunTest::run();
  ASSERT_TRUE(run.plant.has_value()) << core::describe(run.plant.error());
  ASSERT_TRUE(run.outcome.complete) << run.outcome.reason;
  EXPECT_EQ(run.outcome.script_failure, "");
  // The machine's own truth: the carriage went where it was sent.
  const auto truth = CsvTable::load(folder() / "truth.csv");
  const auto carriage = truth.column("y_carriage_m");
  constexpr double kTransmissionGives_m = 1e-3;  // as the trapezoids' budget has it
  EXPECT_NEAR(carriage.back() - carriage.front(), 0.1, kTransmissionGives_m);
  EXPECT_THAT(contents_of(folder() / "events.jsonl"),
              testing::Not(testing::HasSubstr("fault_latched")));

  const auto again = replay_by_inputs(fixture_, 1, folder(), files_.folder());
  ASSERT_TRUE(again.complete) << again.reason;
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    EXPECT_TRUE(contents_of(folder() / file) == contents_of(again.folder / file)) << file;
  }
}

class WallClockBusTest : public WallClockRunTest {};

TEST_P(WallClockBusTest, LoadsTheBusNoMoreThanWasReckonedBeforehand) {
  const auto run = WallClockRunTest::run();
  // Two duties an exchange at most, and a sign of life in each fiftieth.
  const double exchanges = core::seconds(run.outcome.end_ns) / core::seconds(exchange_ns());
  EXPECT_LT(static_cast<double>(run.frames_sent), exchanges * 2.05 + 100);
}

TEST_P(WallClockRunTest, ADamagedRecordIsNoReplay) {
  (void)WallClockRunTest::run();
  auto bytes = contents_of(folder() / kControllerInputsFile);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder() / kControllerInputsFile, std::ios::binary) << bytes;
  const auto again = replay_by_inputs(fixture_, 1, folder(), files_.folder());
  EXPECT_FALSE(again.complete);
  EXPECT_EQ(again.reason, "controller_inputs.bin is damaged");
}

std::string name_of_case(const testing::TestParamInfo<Carried>& each) {
  return each.param.name;
}

constexpr Carried kBus{"can", Scheme::kCan, false};
constexpr Carried kBusAndLines{"can_and_lines", Scheme::kCan, true};
constexpr Carried kBusAndAllLines{"can_and_all_lines", Scheme::kCan, true, true};

INSTANTIATE_TEST_SUITE_P(Carriers, WallClockRunTest,
                         testing::Values(Carried{"local", Scheme::kLocal, false},
                                         Carried{"serial", Scheme::kSerial, false},
                                         Carried{"local_and_lines", Scheme::kLocal, true},
                                         Carried{"local_and_encoders", Scheme::kLocal, false, true},
                                         kBus, kBusAndLines, kBusAndAllLines),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(Carriers, WallClockBusTest, testing::Values(kBus, kBusAndLines),
                         name_of_case);

}  // namespace
}  // namespace towbench::harness
