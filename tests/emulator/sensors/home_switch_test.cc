#include "emulator/sensors/home_switch.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "emulator/rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;
using protocol::InputLine;

constexpr double kPlace_m = 1.2;
constexpr double kWidth_m = 4e-3;
constexpr double kHysteresis_m = 0.2e-3;

HomeParameters home_with(double delay_s) {
  return {.fitted = true,
          .position_m = kPlace_m,
          .width_m = kWidth_m,
          .hysteresis_m = kHysteresis_m,
          .delay_s = delay_s};
}

// Past the switch at one speed, from `from_m` on.
std::vector<LineChange> pass(HomeSwitch& home, double from_m, double speed_m_per_s, int ticks) {
  std::vector<LineChange> all;
  LineChanges changes;
  for (int i = 0; i < ticks; ++i) {
    const double way_m = speed_m_per_s * core::kPlantTick_s;
    changes.clear();
    home.step(i * core::kPlantTick_ns,
              {.before_m = from_m + i * way_m,
               .before_m_per_s = speed_m_per_s,
               .after_m = from_m + (i + 1) * way_m,
               .after_m_per_s = speed_m_per_s},
              changes);
    all.insert(all.end(), changes.begin(), changes.end());
  }
  return all;
}

class Passage : public ::testing::TestWithParam<double> {};

// In at the near edge, out behind the far edge and its hysteresis, either way, to the nanosecond.
TEST_P(Passage, IsActiveWithinItsWidthAndReleasesBehindItsHysteresis) {
  const double speed = GetParam();
  const double from_m = kPlace_m - std::copysign(0.01, speed);
  HomeSwitch home(home_with(0.0), InputLine::kHomeX, from_m);
  EXPECT_FALSE(home.active());
  const auto changes = pass(home, from_m, speed, static_cast<int>(200 / std::fabs(speed)) + 2);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].line, InputLine::kHomeX);
  EXPECT_TRUE(changes[0].active);
  EXPECT_FALSE(changes[1].active);
  const double in_s = (0.01 - 0.5 * kWidth_m) / std::fabs(speed);
  const double out_s = (0.01 + 0.5 * kWidth_m + kHysteresis_m) / std::fabs(speed);
  EXPECT_NEAR(static_cast<double>(changes[0].time_ns), in_s * 1e9, 3.0);
  EXPECT_NEAR(static_cast<double>(changes[1].time_ns), out_s * 1e9, 3.0);
}
// At 60 m/s both edges lie within one tick.
INSTANTIATE_TEST_SUITE_P(Speeds, Passage, ::testing::Values(0.3, -0.3, 2.0, -60.0));

TEST(HomeSwitch, FollowsItsFieldByItsDelayAndNotOneThatPassesFaster) {
  HomeSwitch slow(home_with(0.9e-3), InputLine::kHomeY, kPlace_m - 0.01);
  const auto changes = pass(slow, kPlace_m - 0.01, 0.5, 500);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_NEAR(static_cast<double>(changes[0].time_ns), 16.9e6, 3.0);
  // 4.2 mm at 5 m/s are 0.84 ms.
  HomeSwitch fast(home_with(0.9e-3), InputLine::kHomeY, kPlace_m - 0.01);
  EXPECT_TRUE(pass(fast, kPlace_m - 0.01, 5.0, 100).empty());
}

TEST(HomeSwitch, HoldsItsLevelInsideTheHysteresis) {
  HomeSwitch home(home_with(0.0), InputLine::kHomeY, kPlace_m);
  EXPECT_TRUE(home.active());
  const double edge_m = kPlace_m + 0.5 * kWidth_m;
  EXPECT_TRUE(pass(home, kPlace_m, 0.1, 215).empty());  // 0.15 mm beyond the edge
  EXPECT_EQ(pass(home, edge_m + 0.15e-3, 0.1, 10).size(), 1U);
  EXPECT_FALSE(home.active());
  EXPECT_TRUE(pass(home, edge_m + 0.25e-3, -0.1, 20).empty());  // 0.05 mm outside the edge
}

TEST(HomeSwitch, OfARigHasALineOfItsOwnForEachAxisAndNoneWhereItIsNotFitted) {
  RigParameters parameters_of_rig;
  EXPECT_EQ(Rig(parameters_of_rig, 1).lines() >> 16U, 0U);
  for (const Axis which : core::kAllAxes) {
    RigParameters rig;
    rig.axes[which].exists = true;
    rig.axes[which].hall_max.fitted = false;
    rig.axes[which].start_m = 0.1;
    rig.axes[which].home = {.fitted = true, .position_m = 0.1};
    ASSERT_STREQ(inconsistency(rig), nullptr);
    EXPECT_EQ(Rig(rig, 1).lines() >> 16U, 1U << core::index_of(which));
  }
}

TEST(HomeSwitch, OutsideTheTravelIsRefused) {
  RigParameters rig;
  rig.axes[Axis::kY].home = {.fitted = true, .position_m = 4.0};
  EXPECT_STREQ(inconsistency(rig), "home.position_m must lie within hard_ends");
}

}  // namespace
}  // namespace towbench::emulator
