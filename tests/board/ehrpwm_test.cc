// Against the manual's timing diagrams (SPRUH73 15.2): duty in closed form.
#include "board/ehrpwm.h"

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

constexpr std::uint32_t kTbCtl = 0x00;
constexpr std::uint32_t kTbCnt = 0x08;
constexpr std::uint32_t kTbPrd = 0x0A;
constexpr std::uint32_t kCmpCtl = 0x0E;
constexpr std::uint32_t kCmpA = 0x12;
constexpr std::uint32_t kCmpB = 0x14;
constexpr std::uint32_t kAqCtlA = 0x16;
constexpr std::uint32_t kAqCtlB = 0x18;
constexpr std::uint32_t kTzCtl = 0x28;
constexpr std::uint32_t kTzClr = 0x2E;
constexpr std::uint32_t kTzFrc = 0x30;
using Output = Ehrpwm::Output;

struct EhrpwmFixture : testing::Test {
  Bus bus;
  bool raised = false;
  Ehrpwm pwm{"ehrpwm1", bus, [this](bool level) { raised = level; }};

  EhrpwmFixture() {
    pwm.set_clock(true);
    pwm.store(kCmpCtl, 2, 0x50);  // immediate
    pwm.store(kTbPrd, 2, 999);
    pwm.store(kAqCtlA, 2, 0x12);   // ZRO high, CAU low
    pwm.store(kAqCtlB, 2, 0x102);  // ZRO high, CBU low
    pwm.store(kTbCtl, 2, 0x0008);  // up, immediate period, 100 MHz
    pwm.store(kTbPrd, 2, 999);
  }
  void at(core::Nanoseconds time_ns) {
    bus.now_ns = time_ns;
    pwm.advance(time_ns);
  }
};

TEST_F(EhrpwmFixture, UpCountIsHighForCompareTicksOfPeriodPlusOne) {
  for (const std::uint32_t compare : {0U, 1U, 250U, 999U, 1000U}) {
    pwm.store(kCmpA, 2, compare);
    pwm.store(kCmpB, 2, 1000 - compare);
    EXPECT_EQ(pwm.output(Output::kA).high_ticks, compare);
    EXPECT_EQ(pwm.output(Output::kB).high_ticks, 1000 - compare);
    EXPECT_EQ(pwm.output(Output::kA).period_ticks, 1000U);
  }
}

TEST_F(EhrpwmFixture, UpDownCountIsSymmetric) {
  pwm.store(kTbCtl, 2, 0x000A);
  pwm.store(kTbPrd, 2, 1000);
  pwm.store(kAqCtlA, 2, 0x60);  // CAU high, CAD low
  pwm.store(kCmpA, 2, 400);
  EXPECT_EQ(pwm.output(Output::kA).period_ticks, 2000U);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 1200U) << "from 400 up to 400 down";
  pwm.store(kAqCtlA, 2, 0x90);  // CAU low, CAD high
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 800U);
}

TEST_F(EhrpwmFixture, DownCountSetsAtThePeriodAndClearsAtCompare) {
  pwm.store(kTbCtl, 2, 0x0009);
  pwm.store(kAqCtlA, 2, 0x48);  // PRD high, CAD low
  pwm.store(kCmpA, 2, 300);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 699U) << "from 999 to 300";
}

TEST_F(EhrpwmFixture, AShadowedCompareActsAtTheNextZero) {
  pwm.store(kCmpA, 2, 100);
  pwm.store(kCmpCtl, 2, 0x00);
  at(3'000);  // 300 ticks into the period of 10 us
  pwm.store(kCmpA, 2, 700);
  EXPECT_EQ(pwm.load(kCmpA, 2), 700U) << "the shadow reads back";
  EXPECT_NE(pwm.load(kCmpCtl, 2) & 0x100U, 0U) << "SHDWAFULL";
  at(9'990);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 100U);
  EXPECT_EQ(pwm.next_event_ns(), 10'000);
  at(10'000);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 700U);
  EXPECT_EQ(pwm.load(kCmpCtl, 2) & 0x100U, 0U);
}

TEST_F(EhrpwmFixture, AnImmediateCompareActsAtOnce) {
  pwm.store(kCmpA, 2, 100);
  at(3'000);
  pwm.store(kCmpA, 2, 700);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 700U);
}

TEST_F(EhrpwmFixture, AStoppedTimeBaseFreezesThePinWhereItWas) {
  pwm.store(kCmpA, 2, 500);
  at(2'000);  // count 200: high
  pwm.set_clock(false);
  at(1'000'000);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, pwm.output(Output::kA).period_ticks);
  EXPECT_EQ(pwm.load(kTbCnt, 2), 200U);
  pwm.set_clock(true);
  at(1'000'000 + 6'000);  // count 800: low
  pwm.store(kTbCtl, 2, 0x000B);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 0U);
  pwm.store(kCmpCtl, 2, 0x00);
  pwm.store(kCmpA, 2, 999);
  at(2'000'000);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 0U) << "no load without a time base";
}

TEST_F(EhrpwmFixture, TheCounterRunsAtTheDividedClock) {
  pwm.store(kTbCtl, 2, 0x0008 | 2U << 7U | 1U << 10U);  // /4 /2: 12.5 MHz
  const core::Nanoseconds start_ns = bus.now_ns;
  pwm.store(kTbCnt, 2, 0);
  at(start_ns + 8'000);
  EXPECT_EQ(pwm.load(kTbCnt, 2), 100U);
}

TEST_F(EhrpwmFixture, ASoftwareTripHoldsThePinsUntilItIsCleared) {
  pwm.store(kCmpA, 2, 500);
  pwm.store(kTzCtl, 2, 0x000A);
  pwm.store(kTzFrc, 2, 0x4);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 0U);
  pwm.store(kTzClr, 2, 0x5);
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 500U);
}

TEST_F(EhrpwmFixture, AContinuousForceOverridesTheQualifier) {
  pwm.store(kCmpA, 2, 500);
  pwm.store(0x1C, 2, 0x9);  // A low, B high
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 0U);
  EXPECT_EQ(pwm.output(Output::kB).high_ticks, 1000U);
}

TEST_F(EhrpwmFixture, TheEventInterruptComesEveryThirdZero) {
  pwm.store(0x34, 2, 3);
  pwm.store(0x32, 2, 0x9);
  at(20'000);
  EXPECT_FALSE(raised);
  at(30'000);
  EXPECT_TRUE(raised);
  pwm.store(0x38, 2, 1);
  EXPECT_FALSE(raised);
}

TEST(PwmReset, ComesUpStoppedAndLow) {
  Bus bus;
  Ehrpwm pwm("ehrpwm1", bus, [](bool) {});
  EXPECT_EQ(pwm.load(kTbCtl, 2), 0x0083U);
  EXPECT_FALSE(pwm.is_running());
  EXPECT_EQ(pwm.output(Output::kA).high_ticks, 0U);
}

}  // namespace
}  // namespace towbench::board
