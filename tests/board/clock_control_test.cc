// Clocks against the manual (SPRUH73 chapter 8).
#include "board/clock_control.h"

#include <map>

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

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
