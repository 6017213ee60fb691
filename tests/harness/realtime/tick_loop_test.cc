#include "harness/realtime/tick_loop.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/harness/realtime/scripted_clock.h"

namespace towbench::harness {
namespace {

constexpr core::Nanoseconds kMicrosecond = core::kNanosecondsPerMicrosecond;

class TickLoopTest : public testing::Test {
 protected:
  // The histograms are too large for a test's stack frame.
  void tick(core::Nanoseconds wakes_late_ns, core::Nanoseconds takes_ns) {
    clock_.next_wake_late_ns = wakes_late_ns;
    loop_->wait();
    clock_.time_ns += takes_ns;
  }
  ScriptedClock clock_;
  std::unique_ptr<TickLoop> loop_ = std::make_unique<TickLoop>(
      clock_, TickPolicy{.period_ns = 100 * kMicrosecond, .max_behind = 3});
};

TEST_F(TickLoopTest, NeitherLatenessNorExecutionShiftsTheNextTick) {
  loop_->start();
  for (int i = 0; i < 1000; ++i) {
    tick(7 * kMicrosecond, 20 * kMicrosecond);
  }
  loop_->end_tick();
  EXPECT_EQ(clock_.time_ns, 1000 * 100 * kMicrosecond + 27 * kMicrosecond);
  EXPECT_EQ(loop_->record().lateness.max_ns(), 7 * kMicrosecond);
  EXPECT_EQ(loop_->record().lateness.min_ns(), 7 * kMicrosecond);
  EXPECT_EQ(loop_->record().execution.mean_ns(), 20 * kMicrosecond);
  EXPECT_EQ(loop_->record().execution.count(), 1000U);
  EXPECT_EQ(loop_->record().overruns, 0U);
}

TEST_F(TickLoopTest, AnOverrunIsCaughtUpTickByTickAndCounted) {
  loop_->start();
  tick(0, 10 * kMicrosecond);
  tick(250 * kMicrosecond, 10 * kMicrosecond);  // two ticks behind
  tick(0, 10 * kMicrosecond);                   // late by 160 us: at once
  tick(0, 10 * kMicrosecond);                   // late by 70 us: at once, and caught up
  tick(0, 10 * kMicrosecond);                   // sleeps again
  const auto& record = loop_->record();
  EXPECT_EQ(record.overruns, 2U);
  EXPECT_EQ(record.most_behind, 2U);
  EXPECT_EQ(record.worst_tick, 1U);
  EXPECT_FALSE(record.host_was_late);
  EXPECT_EQ(record.lateness.count(), 5U);
  EXPECT_EQ(clock_.time_ns, 5 * 100 * kMicrosecond + 10 * kMicrosecond);
}

TEST_F(TickLoopTest, MoreTicksBehindThanMayBeCaughtUpMakeTheHostLate) {
  loop_->start();
  tick(0, 0);
  tick(400 * kMicrosecond, 0);
  EXPECT_TRUE(loop_->record().host_was_late);
  EXPECT_EQ(loop_->record().most_behind, 4U);
  EXPECT_EQ(loop_->record().worst_tick, 1U);
  for (int i = 0; i < 100; ++i) {
    tick(0, 0);
  }
  EXPECT_TRUE(loop_->record().host_was_late) << "what came after does not heal it";
}

TEST_F(TickLoopTest, ATickThatTakesTooLongShowsAsExecutionAndDelaysTheNext) {
  loop_->start();
  tick(0, 150 * kMicrosecond);
  tick(0, 0);
  loop_->end_tick();
  EXPECT_EQ(loop_->record().execution.max_ns(), 150 * kMicrosecond);
  EXPECT_EQ(loop_->record().lateness.max_ns(), 50 * kMicrosecond);
}

TEST(DurationHistogram, PercentilesAreThoseOfTheSamples) {
  const auto histogram = std::make_unique<DurationHistogram>();
  EXPECT_EQ(histogram->percentile_ns(0.99), 0);
  for (int i = 1; i <= 1000; ++i) {
    histogram->add(i * kMicrosecond - 1);  // one in each of the first thousand bins
  }
  EXPECT_EQ(histogram->percentile_ns(0.5), 500 * kMicrosecond);
  EXPECT_EQ(histogram->percentile_ns(0.99), 990 * kMicrosecond);
  EXPECT_EQ(histogram->percentile_ns(1.0), 1000 * kMicrosecond - 1)
      << "never above the largest sample";
  EXPECT_EQ(histogram->max_at(), 999U);
  histogram->add(core::kNanosecondsPerSecond);  // beyond the last bin
  histogram->add(-5);
  EXPECT_EQ(histogram->max_ns(), core::kNanosecondsPerSecond);
  EXPECT_EQ(histogram->min_ns(), 0);
  EXPECT_EQ(histogram->in_bin(DurationHistogram::kBins), 1U);
}

}  // namespace
}  // namespace towbench::harness
