// Where a homing met its switch.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/identify/switch_edges.h"

namespace towbench::study::identify {
namespace {

using core::Axis;

constexpr double kPerCount = 2 * std::numbers::pi / 4000;

// A search at 40 mm/s, back off, an approach at 1 mm/s, a declaration, and away.
Recording homing(double outward, std::int64_t shift) {
  Recording data;
  data.rad_per_count[Axis::kY] = kPerCount;
  data.metres_per_count[Axis::kY] = 2e-6;
  double count = 1e5;
  const auto run = [&](double m_per_s, int rows) {
    for (int i = 0; i < rows; ++i) {
      data.time_s.push_back(1e-3 * static_cast<double>(data.rows()));
      data.axes[Axis::kY].reference_velocity_m_per_s.push_back(m_per_s);
      count += 1e-3 * m_per_s / 2e-6;
      data.axes[Axis::kY].count.push_back(static_cast<std::int64_t>(std::floor(count)));
    }
  };
  run(0, 100);
  run(outward * 0.04, 900);
  run(0, 300);
  for (int i = 0; i < 400; ++i) {
    run(-outward * 1e-4 * i, 1);  // speeds up all the way back
  }
  run(0, 300);
  run(outward * 1e-3, 3000);
  run(0, 300);
  count += static_cast<double>(shift);
  run(0, 1);
  run(-outward * 0.04, 500);
  run(0, 100);
  return data;
}

TEST(SwitchEdges, AreWhereTheSearchAndTheApproachStop) {
  for (const double outward : {1.0, -1.0}) {
    const auto found = find_switch_approaches(homing(outward, -37), Axis::kY, 1e-3);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].outward, outward);
    EXPECT_EQ(found[0].fast_from, 100U);
    EXPECT_EQ(found[0].fast_edge, 999U);
    EXPECT_EQ(found[0].slow_edge, 4999U);
    EXPECT_EQ(found[0].declared, 5300U);
    EXPECT_EQ(found[0].shift_counts, -37);
  }
}

TEST(SwitchEdges, TakeTheDeclarationBack) {
  const auto data = homing(1, 250);
  const auto counts =
      counts_in_one_frame(data, Axis::kY, find_switch_approaches(data, Axis::kY, 1e-3));
  ASSERT_EQ(counts.size(), data.rows());
  EXPECT_NEAR(counts[5300], counts[5299], 1);
  EXPECT_EQ(counts[100], static_cast<double>(data.axes[Axis::kY].count[100]) + 0.5);
}

}  // namespace
}  // namespace towbench::study::identify
