// A controller by the wall clock, with clock and controller in memory: no test waits.
#include <deque>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/external/external_bench.h"
#include "harness/files/csv_table.h"
#include "harness/link/unrecorded_plant.h"
#include "harness/realtime/realtime_checks.h"
#include "harness/record/temporary_folder.h"
#include "tests/harness/realtime/scripted_clock.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::Nanoseconds kExchange_ns = core::kNanosecondsPerMillisecond;

// What a controller does, told in exchanges and in ticks of the plant.
struct Habits {
  int answers_after_ticks = 3;
  int slow_exchange = -1;  // this one is answered after `slow_ticks`
  int slow_ticks = 0;
  int drives_from_exchange = 5;
  int silent_from_exchange = 1 << 30;
  int floods_at_exchange = -1;
  bool says_bye_at_50 = false;
};

// Answers each Advanced with a duty and Advance, some ticks later; a tick is one call of listen().
class ScriptedLink final : public protocol::TurnLink {
 public:
  explicit ScriptedLink(const Habits& habits)
      : TurnLink(core::kNanosecondsPerSecond), habits_(habits), ear_(*this) {}
  [[nodiscard]] protocol::MessageSink& peer() noexcept override { return ear_; }
  [[nodiscard]] const protocol::LinkCounts& counts() const noexcept override { return counts_; }
  [[nodiscard]] std::size_t references() const { return ear_.references; }

 private:
  struct Ear final : protocol::MessageSink {
    explicit Ear(ScriptedLink& owner) : link(owner) {}
    using MessageSink::on;
    void on(const protocol::Advanced& advanced) noexcept override {
      link.told_.push_back(advanced.time_ns);
    }
    void on(const protocol::Reference& /*reference*/) noexcept override { ++references; }
    void on(const protocol::Bye& /*bye*/) noexcept override { link.told_bye_ = true; }
    ScriptedLink& link;
    std::size_t references = 0;
  };

  core::Result<Progress> read_once(core::Nanoseconds /*timeout_ns*/) noexcept override {
    const auto tick = reads_++;
    if (told_bye_) {
      watch().on(protocol::Bye{});
      return Progress::kSomething;
    }
    bool said = false;
    while (!told_.empty()) {
      const auto exchange = static_cast<int>(told_.front() / kExchange_ns);
      const int after =
          exchange == habits_.slow_exchange ? habits_.slow_ticks : habits_.answers_after_ticks;
      if (exchange >= habits_.silent_from_exchange ||
          tick * core::kPlantTick_ns < told_.front() + after * core::kPlantTick_ns) {
        break;
      }
      answer(exchange);
      told_.pop_front();
      said = true;
    }
    return said ? Progress::kSomething : Progress::kNothing;
  }
  void answer(int exchange) noexcept {
    if (habits_.says_bye_at_50 && exchange == 50) {
      watch().on(protocol::Bye{});
      return;
    }
    for (int i = 0; exchange == habits_.floods_at_exchange && i < 2000; ++i) {
      watch().on(protocol::Heartbeat{});
    }
    const std::uint16_t ticks = exchange >= habits_.drives_from_exchange ? 10 : 0;
    watch().on(protocol::PwmDuty{.axis = core::Axis::kY,
                                 .enable = true,
                                 .channel_a_ticks = ticks,
                                 .period_ticks = 1000,
                                 .sequence = sequence_++});
    watch().on(protocol::Advance{(exchange + 1) * kExchange_ns});
  }

  Habits habits_;
  Ear ear_;
  protocol::LinkCounts counts_;
  std::deque<core::Nanoseconds> told_;
  bool told_bye_ = false;
  core::Nanoseconds reads_ = 0;
  std::uint32_t sequence_ = 0;
};

struct Ran {
  RunOutcome outcome;
  Check on_time;
  bool host_was_late = false;
  std::size_t references = 0;
};

class ExternalWallClock : public ::testing::Test {
 protected:
  ExternalWallClock() {
    fixture_.experiment.duration_limit_s = 3;
    fixture_.experiment.reference = {{.kind = ReferenceKind::kHold, .at_s = 0, .period_s = 0.2}};
  }
  Ran run(const Habits& habits, core::Nanoseconds host_is_late_ns = 0,
          core::Nanoseconds exchange_ns = kExchange_ns) {
    ScriptedLink link(habits);
    UnrecordedPlant unrecorded;
    StandstillWatch standstill(unrecorded);
    emulator::PlantNode node(fixture_.rig.parameters, 1, {}, standstill);
    FirmwareRecorder recorder(folder_.path(), FirmwareRecorder::Log::kTelemetry);
    protocol::MessageSink nobody;
    ExternalBench bench(fixture_, {node, standstill, nobody}, link, {}, {recorder});
    ScriptedClock clock;
    clock.next_wake_late_ns = host_is_late_ns;
    const auto loop = std::make_unique<TickLoop>(clock, TickPolicy{.max_behind = 20});
    const auto answers = std::make_unique<AnswerWatch>(exchange_ns);
    const protocol::Hello hello{
        .axes_mask = 3,
        .tick_ns = 100'000,
        .exchange_ns = static_cast<std::uint32_t>(exchange_ns),
        .capabilities = protocol::kCapabilityDigest | protocol::kCapabilityReference};
    Ran ran;
    ran.outcome = bench.run_by_the_wall_clock(hello, *loop, *answers, {});
    recorder.flush();
    ran.on_time = controller_on_time(*answers);
    ran.host_was_late = loop->record().host_was_late;
    ran.references = link.references();
    return ran;
  }

  TemporaryFolder folder_;
  ExperimentFixture fixture_;
};

TEST_F(ExternalWallClock, ThePlantGoesOnByItsClockAndAnswersAreTimed) {
  const auto ran = run({});
  EXPECT_TRUE(ran.outcome.complete) << ran.outcome.reason;
  EXPECT_EQ(ran.outcome.script_failure, "");
  EXPECT_EQ(ran.on_time.verdict, Verdict::kPass) << ran.on_time.reason;
  EXPECT_FALSE(ran.host_was_late);
  EXPECT_EQ(ran.outcome.end_ns, 700 * kExchange_ns) << "half a second behind the hold";
  EXPECT_EQ(ran.references, 2U * 699U) << "of both axes, with each Advanced but the last";
  const auto log = CsvTable::load(folder_.path() / "log.csv");
  ASSERT_EQ(log.rows(), 700U);
  // Told at 5 ms, sent at 5.3 ms: the row of 6 ms is the first with a duty.
  EXPECT_EQ(log.column("y_duty_pct")[5], 0.0);
  EXPECT_EQ(log.column("y_duty_pct")[6], 1.0);
}

TEST_F(ExternalWallClock, ALateAnswerWhileDrivingIsInvalidAndThePlantHasNotWaited) {
  const auto ran = run({.slow_exchange = 40, .slow_ticks = 25});
  EXPECT_TRUE(ran.outcome.complete);
  EXPECT_EQ(ran.outcome.end_ns, 700 * kExchange_ns);
  EXPECT_EQ(ran.on_time.verdict, Verdict::kInvalid);
  EXPECT_THAT(ran.on_time.reason, HasSubstr("0.0400 s"));
}

TEST_F(ExternalWallClock, ALateHostIsNoticed) {
  EXPECT_TRUE(run({}, 3 * kExchange_ns).host_was_late);
}

TEST_F(ExternalWallClock, SilenceOfASecondLosesTheController) {
  fixture_.experiment.reference.front().period_s = 2;
  const auto ran = run({.silent_from_exchange = 100});
  EXPECT_TRUE(ran.outcome.complete);
  EXPECT_THAT(ran.outcome.script_failure, HasSubstr("peer is silent"));
  EXPECT_NEAR(core::seconds(ran.outcome.end_ns), 1.1, 2e-3);
}

TEST_F(ExternalWallClock, AFloodOfMessagesLosesIt) {
  const auto ran = run({.floods_at_exchange = 100});
  EXPECT_THAT(ran.outcome.script_failure, HasSubstr("more than 1000 messages"));
  EXPECT_LE(ran.outcome.end_ns, 102 * kExchange_ns);
}

TEST_F(ExternalWallClock, ItsByeEndsTheRun) {
  const auto ran = run({.says_bye_at_50 = true});
  EXPECT_THAT(ran.outcome.script_failure, HasSubstr("the controller ended the run at 0.05"));
}

TEST_F(ExternalWallClock, AnExchangeThatIsNoWholeNumberOfTicksIsRefused) {
  const auto ran = run({}, 0, 150'000);
  EXPECT_FALSE(ran.outcome.complete);
  EXPECT_THAT(ran.outcome.reason, HasSubstr("150000 ns"));
}

}  // namespace
}  // namespace towbench::harness
