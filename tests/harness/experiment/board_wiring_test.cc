// Wiring files: the shipped one is the default, and what cannot be wired is refused.
#include <gtest/gtest.h>

#include "harness/experiment/board_wiring_text.h"

namespace towbench::harness {
namespace {

BoardWiring read(const std::string& text) {
  return read_board_wiring(FixtureFile::parse("schema = 1\n" + text, "wiring.toml"));
}

std::string wiring_refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const FixtureError& error) {
    return error.what();
  }
  return {};
}

void expect_same(const std::optional<BoardPin>& a, const std::optional<BoardPin>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    EXPECT_TRUE(a->same_place(*b)) << a->pin;
    EXPECT_EQ(a->active_low, b->active_low);
  }
}

TEST(BoardWiring, TheShippedFileIsWhatHoldsWithoutOne) {
  const auto shipped = read_board_wiring(FixtureFile::load("fixtures/wirings/macs-board.toml"));
  const BoardWiring standard;
  expect_same(shipped.kill_switch, standard.kill_switch);
  for (const auto axis : core::kPlanarAxes) {
    const auto& a = shipped.axes[axis];
    const auto& b = standard.axes[axis];
    EXPECT_EQ(a.encoder, b.encoder);
    EXPECT_EQ(a.pwm, b.pwm);
    EXPECT_EQ(a.channels_swapped, b.channels_swapped);
    for (const auto pin : {&AxisWiring::direction, &AxisWiring::hall, &AxisWiring::hall_min,
                           &AxisWiring::hall_max, &AxisWiring::ready, &AxisWiring::enable}) {
      expect_same(a.*pin, b.*pin);
    }
  }
}

TEST(BoardWiring, PinsMoveInvertAndAreLeftOut) {
  const auto wiring = read(
      "kill_switch = \"!gpio3.31\"\n"
      "[axis.y]\nencoder = \"eqep0\"\nchannels = \"b_towards_max\"\nhall = \"none\"\n");
  ASSERT_TRUE(wiring.kill_switch);
  EXPECT_EQ(wiring.kill_switch->bank, 3U);
  EXPECT_EQ(wiring.kill_switch->pin, 31U);
  EXPECT_TRUE(wiring.kill_switch->active_low);
  EXPECT_EQ(wiring.axes[core::Axis::kY].encoder, 0U);
  EXPECT_TRUE(wiring.axes[core::Axis::kY].channels_swapped);
  EXPECT_FALSE(wiring.axes[core::Axis::kY].hall);
  EXPECT_TRUE(wiring.axes[core::Axis::kX].hall) << "what is not named stays";
}

TEST(BoardWiring, WhatCannotBeIsRefusedWithItsKey) {
  for (const char* pin :
       {"gpio4.1", "gpio1.32", "gpio1", "14", "gpio1.14 ", "!!gpio1.14", "GPIO1.14"}) {
    const auto text = wiring_refusal("kill_switch = \"" + std::string(pin) + "\"\n");
    EXPECT_NE(text.find("kill_switch"), std::string::npos) << pin << ": " << text;
    EXPECT_NE(text.find("gpioB.P"), std::string::npos) << pin << ": " << text;
  }
  EXPECT_NE(wiring_refusal("kill_switch = \"gpio1.17\"\n").find("axis.y.hall_max has"),
            std::string::npos);
  EXPECT_NE(wiring_refusal("[axis.x]\npwm = \"ehrpwm1\"\n").find("a module of its own"),
            std::string::npos);
  EXPECT_NE(wiring_refusal("[axis.y]\nencoder = \"eqep3\"\n").find("eqep2"), std::string::npos);
  EXPECT_NE(wiring_refusal("[axis.y]\nhall_mim = \"gpio1.1\"\n").find("hall_min"),
            std::string::npos);
  EXPECT_NE(wiring_refusal("console = \"uart1\"\n").find("uart0"), std::string::npos);
}

}  // namespace
}  // namespace towbench::harness
