// Timer, GPIO, interrupt controller and UART against the manual (SPRUH73 chapters 6, 19, 20, 25).
#include <map>

#include <gtest/gtest.h>

#include "board/aintc.h"
#include "board/clock_control.h"
#include "board/dmtimer.h"
#include "board/gpio.h"
#include "board/uart.h"

namespace towbench::board {
namespace {

// ---- DMTIMER ----

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

// ---- GPIO ----

struct GpioFixture : testing::Test {
  Bus bus;
  std::map<unsigned, bool> lines;
  Gpio gpio{"gpio1", bus, [this](unsigned line, bool level) { lines[line] = level; }};
  void at(core::Nanoseconds time_ns) {
    bus.now_ns = time_ns;
    gpio.advance(time_ns);
  }
};

TEST_F(GpioFixture, AnEdgeSetsBothRawRegistersAndTheEnabledLine) {
  gpio.store(0x148, 4, 1U << 14U);  // rising
  gpio.store(0x34, 4, 1U << 14U);   // line 0
  gpio.drive(14, true, 1'000);
  EXPECT_EQ(gpio.next_event_ns(), 1'000);
  at(1'000);
  EXPECT_EQ(gpio.load(0x24, 4), 1U << 14U);
  EXPECT_EQ(gpio.load(0x28, 4), 1U << 14U);
  EXPECT_EQ(gpio.load(0x2C, 4), 1U << 14U);
  EXPECT_EQ(gpio.load(0x30, 4), 0U) << "not enabled on line 1";
  EXPECT_TRUE(lines[0]);
  EXPECT_FALSE(lines[1]);
  EXPECT_EQ(gpio.load(0x138, 4), 1U << 14U);
  gpio.store(0x2C, 4, 1U << 14U);
  EXPECT_FALSE(lines[0]);
  gpio.drive(14, false, 2'000);
  at(2'000);
  EXPECT_FALSE(lines[0]) << "falling edges are not watched";
}

TEST_F(GpioFixture, DebounceWaitsForTheStatedStandstill) {
  gpio.store(0x148, 4, 1U << 6U);
  gpio.store(0x38, 4, 1U << 6U);
  gpio.store(0x150, 4, 1U << 6U);
  gpio.store(0x154, 4, 31);  // 32 steps of 31 us
  gpio.drive(6, true, 100'000);
  gpio.drive(6, false, 300'000);  // a bounce
  gpio.drive(6, true, 400'000);
  at(400'000 + 32 * 31'000 - 1);
  EXPECT_EQ(gpio.load(0x138, 4), 0U);
  EXPECT_FALSE(lines[1]);
  at(400'000 + 32 * 31'000);
  EXPECT_EQ(gpio.load(0x138, 4), 1U << 6U);
  EXPECT_TRUE(lines[1]);
}

TEST_F(GpioFixture, OutputsAreSetClearedAndReadBack) {
  EXPECT_FALSE(gpio.drives(7));
  gpio.store(0x134, 4, ~(1U << 7U));
  EXPECT_TRUE(gpio.drives(7));
  gpio.store(0x194, 4, 1U << 7U);
  EXPECT_TRUE(gpio.output(7));
  EXPECT_NE(gpio.load(0x138, 4) & 1U << 7U, 0U);
  gpio.store(0x190, 4, 1U << 7U);
  EXPECT_FALSE(gpio.output(7));
  EXPECT_EQ(gpio.load(0x114, 4), 1U) << "reset done";
}

TEST_F(GpioFixture, AnOutputThatNobodyHasSetIsNoChoice) {
  gpio.store(0x134, 4, ~(1U << 7U | 1U << 3U));
  EXPECT_TRUE(gpio.drives(7));
  EXPECT_FALSE(gpio.has_chosen(7)) << "low because nobody has said anything";
  gpio.store(0x190, 4, 1U << 7U);
  EXPECT_TRUE(gpio.has_chosen(7)) << "low by name";
  EXPECT_FALSE(gpio.has_chosen(3));
  gpio.store(0x13C, 4, 1U << 3U);
  EXPECT_TRUE(gpio.has_chosen(3)) << "by a change of the whole register";
  gpio.store(0x10, 4, 2);
  EXPECT_FALSE(gpio.has_chosen(7)) << "reset forgets";
}

// ---- AINTC ----

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

// ---- UART ----

struct UartFixture : testing::Test {
  Bus bus;
  bool raised = false;
  Uart uart{"uart0", bus, [this](bool level) { raised = level; }};
  void at(core::Nanoseconds time_ns) {
    bus.now_ns = time_ns;
    uart.advance(time_ns);
  }
};

TEST_F(UartFixture, BytesTakeTenBitTimesEach) {
  EXPECT_NEAR(static_cast<double>(uart.byte_time_ns()), 86'667, 1);
  uart.store(0, 1, 'a');
  uart.store(0, 1, 'b');
  EXPECT_EQ(uart.load(0x14, 1) & 0x60U, 0U);
  at(86'667);
  EXPECT_EQ(uart.take_sent(), "a");
  EXPECT_EQ(uart.load(0x14, 1) & 0x60U, 0x20U) << "holding register empty, shifter busy";
  at(2 * 86'667);
  EXPECT_EQ(uart.take_sent(), "b");
  EXPECT_EQ(uart.load(0x14, 1) & 0x60U, 0x60U);
}

TEST_F(UartFixture, TypedBytesArriveAtTheLinesPaceAndOverrunsAreTold) {
  uart.type(std::string(70, 'x'));
  at(86'667);
  EXPECT_EQ(uart.load(0x64, 1), 1U);
  EXPECT_EQ(uart.load(0, 1), static_cast<unsigned>('x'));
  EXPECT_EQ(uart.load(0x14, 1) & 1U, 0U);
  at(100 * 86'667);
  EXPECT_EQ(uart.load(0x64, 1), 64U);
  EXPECT_EQ(uart.load(0x14, 1) & 3U, 3U) << "data ready, overrun";
  EXPECT_EQ(uart.load(0x14, 1) & 3U, 1U) << "reading clears the overrun";
}

TEST_F(UartFixture, TheDivisorLatchHidesDataAndSetsTheRate) {
  uart.store(0x0C, 1, 0x80);
  uart.store(0, 1, 0x38);  // 312: 9600 baud
  uart.store(4, 1, 0x01);
  EXPECT_EQ(uart.load(0, 1), 0x38U);
  uart.store(0x0C, 1, 3);
  EXPECT_NEAR(static_cast<double>(uart.byte_time_ns()), 1e10 / 9615.4, 10);
}

TEST_F(UartFixture, ReceiveInterruptAtTheTriggerOrAfterFourByteTimes) {
  uart.store(4, 1, 1);
  uart.store(8, 1, 0x01);  // trigger 8
  uart.type("abc");
  at(3 * 86'667);
  EXPECT_FALSE(raised);
  at(7 * 86'667);
  EXPECT_TRUE(raised);
  EXPECT_EQ(uart.load(8, 1) & 0x3EU, 6U << 1U) << "time-out";
  while ((uart.load(0x14, 1) & 1U) != 0) {
    static_cast<void>(uart.load(0, 1));
  }
  EXPECT_FALSE(raised);
}

TEST_F(UartFixture, TriggerLevelsComeFromFcrFromTlrInFoursAndFromBothToTheByte) {
  const auto comes_at = [this](unsigned bytes) {
    uart.type(std::string(bytes, 'x'));
    core::Nanoseconds t = bus.now_ns;
    unsigned level = 0;
    while (!raised && level < 64) {
      at(t += 1000);
      level = uart.load(0x64, 1);
    }
    at(t + 100 * 86'667);
    uart.store(8, 1, uart.load(0x40, 1) != 0 ? 0x43 : 0x03);  // empty
    at(bus.now_ns + 1);
    return level;
  };
  uart.store(4, 1, 1);
  uart.store(8, 1, 0x01);
  EXPECT_EQ(comes_at(60), 8U) << "FCR";
  uart.store(0x0C, 1, 0xBF);
  uart.store(8, 1, 0x10);
  uart.store(0x0C, 1, 3);
  uart.store(0x10, 1, 0x40);
  uart.store(0x1C, 1, 0x50);
  EXPECT_EQ(comes_at(60), 20U) << "TLR in fours";
  uart.store(0x40, 1, 0x80);
  uart.store(8, 1, 0x41);
  EXPECT_EQ(comes_at(60), 21U) << "TLR and FCR to the byte";
}

TEST_F(UartFixture, ADisabledUartSendsNothing) {
  uart.store(0x20, 1, 7);
  uart.store(0, 1, 'a');
  at(1'000'000);
  EXPECT_EQ(uart.take_sent(), "");
  EXPECT_EQ(bus.notes.size(), 1U);
}

// ---- clocks ----

TEST(ClockControl, ModulesAreFunctionalClockDomainsActiveAndPllsFollowTheirMode) {
  Bus bus;
  std::map<unsigned, std::uint32_t> selected;
  ClockControl clocks(bus, [&](unsigned timer, std::uint32_t s) { selected[timer] = s; });
  clocks.store(0x80, 4, 0x3'0002);
  EXPECT_EQ(clocks.load(0x80, 4), 2U) << "IDLEST reads 0";
  EXPECT_EQ(clocks.load(0x00, 4) & ~3U, ~3U);
  EXPECT_EQ(clocks.load(0x420, 4), 1U);
  clocks.store(0x488, 4, 4);
  EXPECT_EQ(clocks.load(0x420, 4), 0x100U) << "bypassed";
  clocks.store(0x508, 4, 2);
  EXPECT_EQ(selected[2], 2U);
}

}  // namespace
}  // namespace towbench::board
