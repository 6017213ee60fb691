// Whole runs whose encoders are lines, both sides in this thread, without a kernel.
#include "harness/link/encoder_lines.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/link/wires.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/plant_recorder.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/protocol/edges_in_memory.h"

namespace towbench::harness {
namespace {

using protocol::EdgesInMemory;
using ::testing::HasSubstr;
using ::testing::Not;

// A clock that goes on a little whenever somebody looks.
struct LookedAtClock {
  core::Nanoseconds operator()() { return now_ns += 1000; }
  core::Nanoseconds now_ns = 0;
};

// A plant behind its lines. Messages are calls.
class PlantBehindLines final : public PlantEnd {
 public:
  PlantBehindLines(const ExperimentFixture& fixture, emulator::PlantObserver& observer,
                   const PlantWires& wires)
      : node_(fixture.rig.parameters, 1, fixture.experiment.events, observer), wires_(wires) {}
  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    path_.emplace(node_, node_, controller, wires_, EdgeTimes::kOfExchange);
    node_.connect(path_->from_plant());
    to_plant_.to = &path_->from_controller();
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn /*expected*/) noexcept override {
    const auto lines = path_->status();
    if (!lines) {
      node_.peer_lost(lines.error());
    }
    return lines;
  }
  std::function<void(core::Nanoseconds)> before_exchange;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(PlantBehindLines& the_owner) noexcept : owner(the_owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to->on(message);
    }
    void handle(const protocol::Advance& advance) noexcept {
      if (owner.before_exchange) {
        owner.before_exchange(advance.until_ns);
      }
      to->on(advance);
    }
    PlantBehindLines& owner;
    protocol::MessageSink* to = nullptr;
  };
  emulator::PlantNode node_;
  PlantWires wires_;
  ToPlant to_plant_{*this};
  std::optional<WiredPath> path_;
};

class EncoderLinesTest : public testing::Test {
 protected:
  RunOutcome run(const std::string& experiment, EdgesInMemory& lines) {
    fixture_ = Runs::shipped(experiment);
    for (auto& axis : fixture_.controller.configuration.axes) {
      axis.plausibility.index_fitted = lines.reader().has_index();
    }
    PlantRecorder plant_recorder(folder(), fixture_.rig.parameters);
    PlantBehindLines plant(fixture_, plant_recorder, {.encoders = &lines.driver()});
    plant.before_exchange = before_exchange_;
    EncoderLinesAtController counted(plant, lines.reader(), EdgeTimes::kOfExchange);
    ControllerRecorder recorder(folder());
    LockstepBench bench(fixture_.controller.configuration, fixture_.rig.hash, counted, &recorder);
    auto outcome = play(fixture_.experiment, bench, recorder, {});
    outcome.control_period_ns = fixture_.controller.configuration.control_period_ns();
    plant_recorder.flush();
    outcome.writes_succeeded = outcome.writes_succeeded && plant_recorder.good();
    merge_events(folder());
    return outcome;
  }
  [[nodiscard]] std::string events() const { return contents_of(folder() / "events.jsonl"); }
  [[nodiscard]] const std::filesystem::path& folder() const { return files_.folder(); }

  TemporaryFixtures files_;
  ExperimentFixture fixture_;
  LookedAtClock clock_;
  std::function<void(core::Nanoseconds)> before_exchange_;
};

class EncoderLinesVerdictTest : public EncoderLinesTest,
                                public testing::WithParamInterface<const char*> {};

TEST_P(EncoderLinesVerdictTest, IsTheVerdictOfOneProcess) {
  EdgesInMemory lines([this] { return clock_(); });
  const auto outcome = run(GetParam(), lines);
  ASSERT_TRUE(outcome.complete) << outcome.reason;
  const auto judgement = judge(folder(), fixture_, outcome);
  EXPECT_EQ(judgement.verdict, Verdict::kPass);
  for (const auto& check : judgement.checks) {
    EXPECT_EQ(check.verdict, Verdict::kPass) << check.name << ": " << check.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Demo, EncoderLinesVerdictTest,
                         testing::Values("trapezoid-400", "circle", "pulses", "endstop-y-max"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_F(EncoderLinesTest, WithoutTheIndexNothingElseIsMissing) {
  EdgesInMemory lines([this] { return clock_(); }, false);
  const auto outcome = run("wall-clock-window", lines);
  ASSERT_TRUE(outcome.complete) << outcome.reason;
  EXPECT_THAT(events(), Not(HasSubstr("fault_latched")));
}

TEST_F(EncoderLinesTest, AQueueThatOverflowsStopsTheController) {
  EdgesInMemory lines([this] { return clock_(); }, true, 64);  // 0.4 m/s on Y: 178 an exchange
  const auto outcome = run("trapezoid-400", lines);
  EXPECT_FALSE(outcome.complete);
  EXPECT_THAT(outcome.reason, HasSubstr("lost or out of order"));
  EXPECT_THAT(events(), HasSubstr("fault_latched"));
  EXPECT_THAT(events(), HasSubstr("320"));
}

TEST_F(EncoderLinesTest, AnInterruptThatNobodyToldOfStopsTheController) {
  EdgesInMemory lines([this] { return clock_(); });
  before_exchange_ = [&](core::Nanoseconds until_ns) {
    if (until_ns == core::kNanosecondsPerSecond) {
      lines.coalesce_one();
    }
  };
  const auto outcome = run("trapezoid-400", lines);
  EXPECT_FALSE(outcome.complete);
  EXPECT_THAT(events(), HasSubstr("fault_latched"));
}

TEST_F(EncoderLinesTest, AnEdgeThatNeverGotOntoTheLineStopsTheController) {
  EdgesInMemory lines([this] { return clock_(); });
  before_exchange_ = [&](core::Nanoseconds until_ns) {
    if (until_ns == core::kNanosecondsPerSecond) {
      lines.swallow_one();
    }
  };
  const auto outcome = run("trapezoid-400", lines);
  EXPECT_FALSE(outcome.complete);
  EXPECT_THAT(outcome.reason, HasSubstr("lost or out of order"));
  EXPECT_THAT(events(), HasSubstr("fault_latched"));
}

TEST_F(EncoderLinesTest, APlantThatSendsItsEdgesOverTheCarrierIsRefused) {
  struct Nobody final : protocol::MessageSink {
  } controller;
  EdgesInMemory lines([this] { return clock_(); });
  struct Sender final : PlantEnd {
    protocol::MessageSink& sink() noexcept override { return nobody; }
    void connect(protocol::MessageSink& sink) noexcept override { to = &sink; }
    core::Status wait_for(protocol::Turn /*expected*/) noexcept override { return {}; }
    struct Deaf final : protocol::MessageSink {
    } nobody;
    protocol::MessageSink* to = nullptr;
  } plant;
  EncoderLinesAtController counted(plant, lines.reader(), EdgeTimes::kOfKernel);
  counted.connect(controller);
  ASSERT_TRUE(counted.wait_for(protocol::Turn::kAdvanced).has_value());
  plant.to->on(protocol::EncoderReport{});
  const auto status = counted.wait_for(protocol::Turn::kAdvanced);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), core::ErrorCode::kProtocolCapabilities);
}

// Against the table of the encoder (quadrature_encoder.h): levels of four counts upwards.
TEST(LineCount, CountsAsTheTableOfLevelsSays) {
  constexpr std::array<unsigned, 4> kLevels{0b00, 0b01, 0b11, 0b10};  // bit 0 A, bit 1 B
  LineCount lines;
  const auto step_to = [&](int count) {
    const unsigned to = kLevels[static_cast<unsigned>(count) & 3U];
    const unsigned changed = to ^ (lines.levels() & 3U);
    ASSERT_TRUE(changed == 1 || changed == 2);
    lines.toggle(changed == 1 ? protocol::EncoderLine::kA : protocol::EncoderLine::kB);
    ASSERT_EQ(lines.count(), count);
  };
  for (int count = 1; count <= 9; ++count) {
    step_to(count);
  }
  lines.toggle(protocol::EncoderLine::kIndex);
  for (int count = 8; count >= -9; --count) {
    step_to(count);
  }
  lines.toggle(protocol::EncoderLine::kIndex);  // falls: latches nothing
  EXPECT_EQ(lines.index_count(), 9);
  EXPECT_EQ(lines.index_pulses(), 1U);
}

}  // namespace
}  // namespace towbench::harness
