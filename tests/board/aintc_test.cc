// The interrupt controller against the manual (SPRUH73 chapter 6).
#include "board/aintc.h"

#include <gtest/gtest.h>

#include "board/dmtimer.h"

namespace towbench::board {
namespace {

struct AintcFixture : testing::Test {
  Bus bus;
  Aintc aintc{bus};
  void enable(unsigned n, unsigned priority) {
    aintc.store(0x100 + 4 * n, 4, priority << 2U);
    aintc.store(0x88 + 0x20 * (n / 32), 4, 1U << (n % 32));
  }
};

TEST_F(AintcFixture, OffersTheMostUrgentOfThoseThatAreEnabled) {
  aintc.set_input(68, true);
  EXPECT_FALSE(aintc.offers()) << "masked after reset";
  enable(68, 5);
  EXPECT_TRUE(aintc.offers());
  enable(98, 2);
  aintc.set_input(98, true);
  EXPECT_EQ(aintc.load(0x40, 4) & 0x7FU, 98U);
  EXPECT_EQ(aintc.load(0x60, 4), 2U);
}

TEST_F(AintcFixture, NothingIsOfferedBetweenAcceptanceAndNewAgreement) {
  enable(68, 5);
  enable(98, 2);
  aintc.set_input(68, true);
  aintc.accept();
  aintc.set_input(98, true);
  EXPECT_FALSE(aintc.offers());
  EXPECT_EQ(aintc.load(0x40, 4) & 0x7FU, 68U);
  aintc.store(0x48, 4, 1);
  EXPECT_TRUE(aintc.offers());
  EXPECT_EQ(aintc.load(0x40, 4) & 0x7FU, 98U);
}

TEST_F(AintcFixture, TheThresholdLetsOnlyMoreUrgentOnesPassAndNeverMasksPriorityZero) {
  enable(68, 5);
  enable(98, 4);
  enable(99, 0);
  aintc.store(0x68, 4, 5);
  aintc.set_input(68, true);
  EXPECT_FALSE(aintc.offers());
  aintc.set_input(98, true);
  EXPECT_TRUE(aintc.offers());
  aintc.store(0x68, 4, 0);
  EXPECT_FALSE(aintc.offers());
  aintc.set_input(99, true);
  EXPECT_TRUE(aintc.offers());
  aintc.store(0x68, 4, 0xFF);
  EXPECT_EQ(aintc.load(0x40, 4) & 0x7FU, 99U);
}

TEST_F(AintcFixture, MasksSoftInterruptsAndPendingRegisters) {
  enable(2, 1);
  aintc.store(0x90, 4, 1U << 2U);  // ISR_SET0
  EXPECT_TRUE(aintc.offers());
  EXPECT_EQ(aintc.load(0x98, 4), 1U << 2U);
  aintc.store(0x8C, 4, 1U << 2U);  // MIR_SET0
  EXPECT_FALSE(aintc.offers());
  EXPECT_EQ(aintc.load(0x80, 4), 1U << 2U) << "ITR shows it before masking";
  aintc.store(0x94, 4, 1U << 2U);
  EXPECT_EQ(aintc.load(0x80, 4), 0U);
}

TEST_F(AintcFixture, AnInterruptCanBeLostOrDelayedAsAFault) {
  enable(68, 5);
  aintc.lose(68, 1);
  aintc.set_input(68, true);
  EXPECT_FALSE(aintc.offers());
  aintc.set_input(68, false);
  aintc.delay(68, 50'000);
  aintc.set_input(68, true);
  EXPECT_FALSE(aintc.offers());
  EXPECT_EQ(aintc.next_event_ns(), 50'000);
  aintc.advance(50'000);
  EXPECT_TRUE(aintc.offers());
}

TEST_F(AintcFixture, EveryEventOfATimerCountsAsOneThatIsLost) {
  enable(68, 5);
  Dmtimer timer("dmtimer2", bus, [this](bool level) { aintc.set_input(68, level); });
  aintc.lose(68, 2);
  timer.store(0x40, 4, 0U - 24'000U);
  timer.store(0x3C, 4, 0U - 24'000U);
  timer.store(0x2C, 4, 2);
  timer.store(0x38, 4, 3);
  for (int ms = 1; ms <= 3; ++ms) {
    bus.now_ns = ms * core::kNanosecondsPerMillisecond;
    timer.advance(bus.now_ns);
    EXPECT_EQ(aintc.offers(), ms == 3) << ms;
  }
  EXPECT_EQ(aintc.lost(68), 2U);
}

}  // namespace
}  // namespace towbench::board
