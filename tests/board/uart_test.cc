// The UART against the manual (SPRUH73 chapter 19).
#include "board/uart.h"

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

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

}  // namespace
}  // namespace towbench::board
