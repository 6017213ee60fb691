// GPIO against the manual (SPRUH73 chapter 25).
#include "board/gpio.h"

#include <map>

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

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

}  // namespace
}  // namespace towbench::board
