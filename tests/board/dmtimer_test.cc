// The timer against the manual (SPRUH73 chapter 20).
#include "board/dmtimer.h"

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

struct TimerFixture : testing::Test {
  Bus bus;
  bool raised = false;
  Dmtimer timer{"dmtimer2", bus, [this](bool level) { raised = level; }};
  void at(core::Nanoseconds time_ns) {
    bus.now_ns = time_ns;
    timer.advance(time_ns);
  }
};

TEST_F(TimerFixture, OverflowsEveryReloadPeriodAndRaisesItsInterrupt) {
  timer.store(0x40, 4, 0U - 24'001U);
  timer.store(0x3C, 4, 0U - 24'001U);
  timer.store(0x2C, 4, 2);
  timer.store(0x38, 4, 3);
  const core::Nanoseconds first_ns = timer.next_event_ns();
  EXPECT_NEAR(static_cast<double>(first_ns), 24'001 * 1000.0 / 24.0, 1.0);
  at(first_ns - 1);
  EXPECT_FALSE(raised);
  at(first_ns);
  EXPECT_TRUE(raised);
  EXPECT_EQ(timer.load(0x28, 4), 2U);
  timer.store(0x28, 4, 2);
  EXPECT_FALSE(raised);
  at(first_ns * 1000);
  EXPECT_NEAR(static_cast<double>(timer.next_event_ns()), 1001 * 24'001 * 1000.0 / 24.0, 2.0)
      << "no drift over a thousand periods";
}

TEST_F(TimerFixture, WithoutAutoReloadItStopsAfterOneOverflow) {
  timer.store(0x3C, 4, 0U - 240U);
  timer.store(0x38, 4, 1);
  at(10'000);
  EXPECT_EQ(timer.load(0x38, 4) & 1U, 0U);
  EXPECT_EQ(timer.next_event_ns(), kNever);
  EXPECT_EQ(timer.load(0x24, 4), 2U) << "raw status without enable";
  EXPECT_FALSE(raised);
}

TEST_F(TimerFixture, PrescalerCompareAndSlowClock) {
  timer.store(0x38, 4, 1U | 1U << 5U | 2U << 2U);  // /8
  at(8'000);
  EXPECT_EQ(timer.load(0x3C, 4), 24U);
  timer.store(0x38, 4, 0);
  timer.store(0x3C, 4, 0);
  timer.store(0x4C, 4, 48);
  timer.store(0x2C, 4, 1);
  timer.store(0x38, 4, 1U | 1U << 6U);
  at(10'000);
  EXPECT_TRUE(raised) << "compare after 2 us";
  timer.store(0x38, 4, 0);
  timer.set_clock(kSlowOscillator);
  timer.store(0x3C, 4, 0);
  timer.store(0x38, 4, 1);
  at(10'000 + core::kNanosecondsPerSecond);
  EXPECT_NEAR(timer.load(0x3C, 4), 32'768.0, 1.0);
}

}  // namespace
}  // namespace towbench::board
