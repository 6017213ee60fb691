// Ramps of duty on an axis whose break-away is known.
#include "study/identify/break_away.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::study::identify {
namespace {

using core::Axis;

// Levels of 0.1 % every 300 ms up to where J q'' = k (u - u_0) has passed 8 mm/s; below u_0 each
// step stretches a transmission by a few counts and then stands.
Recording ramp(double breaks_at_pct, double rad_per_s2_per_pct) {
  constexpr double kPerCount = 2 * std::numbers::pi / 4000;
  constexpr double kMetresPerRad = 1.43e-3;
  Recording data;
  data.period_s = 1e-3;
  data.rad_per_count[Axis::kY] = kPerCount;
  data.metres_per_count[Axis::kY] = kPerCount * kMetresPerRad;
  auto& axis = data.axes[Axis::kY];
  double angle = 0;
  double speed = 0;
  for (int k = 0; speed * kMetresPerRad < 8e-3; ++k) {
    const double duty = 0.1 * (1 + k / 300);
    const double excess = duty - breaks_at_pct;
    speed += excess > 0 ? 1e-3 * rad_per_s2_per_pct * excess : 0.0;
    angle += 1e-3 * speed;
    const double creep = 7 * (duty / 0.1 + std::min(1.0, (k % 300) / 60.0));
    data.time_s.push_back(1e-3 * k);
    axis.duty_pct.push_back(duty);
    axis.mode.push_back(1);
    axis.count.push_back(static_cast<std::int64_t>(std::floor(angle / kPerCount + creep)));
  }
  return data;
}

// With this inertia an axis a tenth of a step above break-away takes two more levels to be fast.
TEST(BreakAway, LiesBetweenTheLevelThatStartedTheMotionAndTheOneBefore) {
  for (const double beyond : {0.006, 0.02, 0.05, 0.08, 0.098}) {
    const double level = 4.2;
    const auto data = ramp(level - beyond, 58);
    const auto found = find_break_aways(data, Axis::kY, 8e-3);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].duty_pct, level - 0.05, 1e-6) << beyond;
    EXPECT_NEAR(found[0].step_pct, 0.1, 1e-9);
  }
}

// Fast after 11 ms: the mean over the 20 ms before that is a quarter of the last speed.
TEST(BreakAway, IsToldOfALightAxisThatJumpsAway) {
  const auto found = find_break_aways(ramp(4.15, 10'000), Axis::kY, 8e-3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].duty_pct, 4.15, 1e-6);
}

TEST(BreakAway, IsNotToldOfARampThatGaveUp) {
  auto data = ramp(4.2, 58);
  for (auto& count : data.axes[Axis::kY].count) {
    count = 0;
  }
  EXPECT_TRUE(find_break_aways(data, Axis::kY, 8e-3).empty());
}

}  // namespace
}  // namespace towbench::study::identify
