// What the panel takes a count for, of BBMC and of a program on another machine.
#include "harness/panel/shown_configuration.h"

#include <numbers>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using core::Axis;

TEST(ShownConfiguration, IsBbmcsWhereBbmcDrives) {
  const auto fixture = load_experiment("fixtures/experiments/one-axis.toml");
  const auto& believed = fixture.controller.configuration.axes[Axis::kY];
  const auto shown = shown_configuration(fixture).axes[Axis::kY];
  EXPECT_EQ(shown.m_per_count(), believed.m_per_count());
  EXPECT_EQ(shown.ends.soft_max_count, believed.ends.soft_max_count);
}

// Radians of a joint: 4000 counts a motor turn, 100 of them a turn of the arm.
TEST(ShownConfiguration, IsTheRigsWhereAProgramDrives) {
  const auto fixture = load_experiment("fixtures/machines/joint/experiment.toml");
  const auto shown = shown_configuration(fixture).axes[Axis::kY];
  EXPECT_DOUBLE_EQ(shown.m_per_count(), 2.0 * std::numbers::pi / 400'000.0);
  EXPECT_NEAR(static_cast<double>(shown.ends.soft_max_count) * shown.m_per_count(), 2.0, 1e-5);
}

}  // namespace
}  // namespace towbench::harness
