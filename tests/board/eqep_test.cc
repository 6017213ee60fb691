// Against the manual's description of the peripheral (SPRUH73 15.4) and closed forms of motion.
#include "board/eqep.h"

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

constexpr std::uint32_t kPosition = 0x00;
constexpr std::uint32_t kInitial = 0x04;
constexpr std::uint32_t kMaximum = 0x08;
constexpr std::uint32_t kIndexLatch = 0x10;
constexpr std::uint32_t kUnitPeriod = 0x20;
constexpr std::uint32_t kDecoderControl = 0x28;
constexpr std::uint32_t kControl = 0x2A;
constexpr std::uint32_t kCapture = 0x2C;
constexpr std::uint32_t kFlags = 0x32;
constexpr std::uint32_t kClear = 0x34;
constexpr std::uint32_t kStatus = 0x38;
constexpr std::uint32_t kTimer = 0x3A;
constexpr std::uint32_t kPeriod = 0x3C;
constexpr std::uint32_t kEnable = 0x30;

struct EqepFixture : testing::Test {
  Bus bus;
  bool raised = false;
  Eqep eqep{"eqep1", bus, [this](bool level) { raised = level; }};
  unsigned phase = 0;

  EqepFixture() {
    eqep.store(kMaximum, 4, 0xFFFF'FFFFU);
    eqep.store(kControl, 2, 0x1018);  // reset at maximum, index latch rising, on
    eqep.store(kCapture, 2, 0x8060);  // 100 MHz / 64, every edge
  }
  void at(core::Nanoseconds time_ns) {
    bus.now_ns = time_ns;
    eqep.advance(time_ns);
  }
  // A leads B upwards: A, B, A, B ...; downwards the same edges backwards.
  void step(int direction, core::Nanoseconds time_ns) {
    const bool line_a = direction > 0 ? phase % 2 == 0 : phase % 2 == 1;
    eqep.push_edge(line_a ? EncoderLine::kA : EncoderLine::kB, time_ns);
    phase = (phase + (direction > 0 ? 1U : 3U)) % 4;
  }
};

TEST_F(EqepFixture, CountsEveryEdgeUpAndDown) {
  core::Nanoseconds time_ns = 0;
  for (int i = 0; i < 1000; ++i) {
    step(1, time_ns += 1000);
  }
  for (int i = 0; i < 300; ++i) {
    step(-1, time_ns += 1000);
  }
  at(time_ns);
  EXPECT_EQ(eqep.load(kPosition, 4), 700U);
  EXPECT_EQ(eqep.edges_decoded(), 1300U);
  EXPECT_EQ(eqep.load(kStatus, 2) & 0x20U, 0U) << "QDF: last direction is down";
}

TEST_F(EqepFixture, AnEdgeCountsAtItsOwnTimeAndNotBefore) {
  step(1, 5'000);
  step(1, 6'000);
  at(5'999);
  EXPECT_EQ(eqep.load(kPosition, 4), 1U);
  at(6'000);
  EXPECT_EQ(eqep.load(kPosition, 4), 2U);
}

TEST_F(EqepFixture, ItsCountBeginsWithWhatIsLoadedAndGoesOnOverTheWrap) {
  eqep.store(kMaximum, 4, 9);
  step(1, 500);
  at(500);
  EXPECT_EQ(eqep.count(), 1);
  eqep.store(kPosition, 4, 8);
  EXPECT_EQ(eqep.count(), 8);
  for (int i = 1; i <= 5; ++i) {
    step(1, 1000 * i);
  }
  at(5000);
  EXPECT_EQ(eqep.load(kPosition, 4), 3U);
  EXPECT_EQ(eqep.count(), 13);
  eqep.store(kInitial, 4, 0xFFFF'FFFE);
  eqep.store(kControl, 2, 0x1098);  // software initialisation
  EXPECT_EQ(eqep.count(), -2);
}

TEST_F(EqepFixture, WrapsAtTheMaximumBothWaysAndSaysSo) {
  eqep.store(kMaximum, 4, 9);
  eqep.store(kPosition, 4, 9);
  step(1, 1000);
  at(1000);
  EXPECT_EQ(eqep.load(kPosition, 4), 0U);
  EXPECT_NE(eqep.load(kFlags, 2) & 0x40U, 0U) << "PCO";
  step(-1, 2000);
  at(2000);
  EXPECT_EQ(eqep.load(kPosition, 4), 9U);
  EXPECT_NE(eqep.load(kFlags, 2) & 0x20U, 0U) << "PCU";
  eqep.store(kClear, 2, 0xFFFF);
  EXPECT_EQ(eqep.load(kFlags, 2), 0U);
}

// v = 1 count of 2.2 um in T: from 0.1 mm/s to 0.6 m/s the period in ticks of 640 ns, to one tick.
TEST_F(EqepFixture, CapturePeriodIsTheTimeBetweenEdgesFromCreepToFullSpeed) {
  constexpr double kCount_m = 2.2456e-6;
  core::Nanoseconds time_ns = 1'000'000;
  for (const double speed_m_per_s : {1e-4, 3e-4, 1e-3, 1e-2, 0.1, 0.3, 0.6}) {
    const auto gap_ns = static_cast<core::Nanoseconds>(kCount_m / speed_m_per_s * 1e9);
    for (int i = 0; i < 3; ++i) {
      step(1, time_ns += gap_ns);
      at(time_ns);
    }
    EXPECT_NEAR(eqep.load(kPeriod, 2), static_cast<double>(gap_ns) / 640.0, 1.0) << speed_m_per_s;
    EXPECT_EQ(eqep.load(kStatus, 2) & 0x8U, 0U) << "no overflow at " << speed_m_per_s;
    EXPECT_NE(eqep.load(kStatus, 2) & 0x80U, 0U) << "UPEVNT";
  }
}

TEST_F(EqepFixture, TheCaptureTimerSinceTheLastEdgeRunsAndItsOverflowIsToldOnce) {
  step(1, 640'000);
  at(640'000 + 640 * 1234);
  EXPECT_EQ(eqep.load(kTimer, 2), 1234U);
  at(640'000 + 640 * 65'535);
  EXPECT_EQ(eqep.load(kStatus, 2) & 0x8U, 0U);
  at(640'000 + 640 * 65'536);
  EXPECT_NE(eqep.load(kStatus, 2) & 0x8U, 0U) << "COEF";
  eqep.store(kStatus, 2, 0x8);
  EXPECT_EQ(eqep.load(kStatus, 2) & 0x8U, 0U) << "write 1 clears";
}

TEST_F(EqepFixture, AReversalBetweenTwoLatchesIsADirectionError) {
  step(1, 10'000);
  step(1, 20'000);
  step(-1, 30'000);
  at(30'000);
  EXPECT_NE(eqep.load(kStatus, 2) & 0x4U, 0U) << "CDEF";
}

TEST_F(EqepFixture, EveryFourthCountMakesTheUnitEvent) {
  eqep.store(kCapture, 2, 0x8002);  // 100 MHz, UPPS = 4 counts
  core::Nanoseconds time_ns = 0;
  for (int i = 0; i < 8; ++i) {
    step(1, time_ns += 5'000);
  }
  at(time_ns);
  EXPECT_EQ(eqep.load(kPeriod, 2), 2'000U) << "four counts of 5 us in ticks of 10 ns";
}

TEST_F(EqepFixture, BothChannelsWithinOneClockAreAPhaseErrorAndCountNothing) {
  step(1, 1'000);
  step(1, 2'000);
  eqep.push_edge(EncoderLine::kA, 3'000);
  eqep.push_edge(EncoderLine::kB, 3'005);
  at(4'000);
  EXPECT_EQ(eqep.load(kPosition, 4), 2U);
  EXPECT_NE(eqep.load(kFlags, 2) & 0x4U, 0U) << "PHE";
}

TEST_F(EqepFixture, TheIndexLatchesThePosition) {
  for (int i = 0; i < 5; ++i) {
    step(1, 1'000 * (i + 1));
  }
  eqep.push_edge(EncoderLine::kIndex, 5'500);
  step(1, 6'000);
  eqep.push_edge(EncoderLine::kIndex, 6'500);
  at(7'000);
  EXPECT_EQ(eqep.load(kIndexLatch, 4), 5U);
  EXPECT_NE(eqep.load(kFlags, 2) & 0x400U, 0U) << "IEL";
  EXPECT_EQ(eqep.load(kPosition, 4), 6U);
}

TEST_F(EqepFixture, SwapAndPolarityTurnTheDirection) {
  for (const std::uint32_t control : {1U << 10U, 1U << 8U, 1U << 7U}) {
    eqep.store(kDecoderControl, 2, control);
    eqep.store(kPosition, 4, 100);
    step(1, bus.now_ns + 1'000);
    at(bus.now_ns + 1'000);
    EXPECT_EQ(eqep.load(kPosition, 4), 99U) << control;
  }
}

TEST_F(EqepFixture, TheUnitTimerLatchesAndInterrupts) {
  eqep.store(kUnitPeriod, 4, 100'000);  // 1 ms
  eqep.store(kEnable, 2, 0x800);
  eqep.store(kControl, 2, 0x101E);  // QCLM, UTE
  EXPECT_EQ(eqep.next_event_ns(), 1'000'000);
  step(1, 900'000);
  at(1'000'000);
  EXPECT_TRUE(raised);
  EXPECT_EQ(eqep.load(0x18, 4), 1U) << "QPOSLAT";
  EXPECT_EQ(eqep.load(0x3E, 2), 156U) << "QCTMRLAT: 100 us in ticks of 640 ns";
  eqep.store(kClear, 2, 0x801);
  EXPECT_FALSE(raised);
}

TEST_F(EqepFixture, BytesHalfwordsAndWordsReachTheSameRegisters) {
  eqep.store(kMaximum, 4, 0x1234'5678);
  EXPECT_EQ(eqep.load(kMaximum, 1), 0x78U);
  EXPECT_EQ(eqep.load(kMaximum + 1, 2), 0x3456U);
  EXPECT_EQ(eqep.load(kDecoderControl, 4), 0x1018'0000U);
  eqep.store(kMaximum + 3, 1, 0xFF);
  EXPECT_EQ(eqep.load(kMaximum, 4), 0xFF34'5678U);
}

TEST_F(EqepFixture, NothingCountsWhileTheCounterIsOff) {
  eqep.store(kControl, 2, 0x1010);
  step(1, 1'000);
  at(2'000);
  EXPECT_EQ(eqep.load(kPosition, 4), 0U);
  EXPECT_EQ(eqep.edges_decoded(), 0U);
}

}  // namespace
}  // namespace towbench::board
