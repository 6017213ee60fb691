// Shapes without a law, on motions whose values are known.
#include "study/diagnose/free_shapes.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::study::diagnose {
namespace {

using Eigen::VectorXd;

// 20 s of a sine at 1 kHz.
Motion sine() {
  Motion m;
  m.time_s = VectorXd::LinSpaced(20001, 0, 20);
  m.position_m = (0.7 * m.time_s.array()).sin();
  m.speed_m_per_s = 0.7 * (0.7 * m.time_s.array()).cos();
  m.acceleration_m_per_s2 = -0.49 * m.position_m;
  m.input_N = 3 * m.acceleration_m_per_s2 + 0.1 * m.speed_m_per_s;
  return m;
}

const FreeShape& named(const std::vector<FreeShape>& shapes, const std::string& coordinate) {
  return *std::find_if(shapes.begin(), shapes.end(),
                       [&](const FreeShape& shape) { return shape.coordinate == coordinate; });
}

// The grid leaves out cells that the motion hardly enters.
TEST(FreeShapes, OfBinsCoverEachSampleOnce) {
  const Motion motion = sine();
  const auto shapes = free_shapes({motion});
  ASSERT_EQ(shapes.size(), 10U);
  for (const FreeShape& shape : shapes) {
    if (shape.at.empty() && shape.coordinate != "position and speed") continue;
    VectorXd sum = VectorXd::Zero(motion.time_s.size());
    for (Eigen::Index i = 0; i < shape.columns; ++i) sum += shape.force(i, motion);
    const bool is_grid = shape.coordinate == "position and speed";
    EXPECT_GE(sum.mean(), is_grid ? 0.99 : 1.0) << shape.coordinate;
    EXPECT_EQ(sum.maxCoeff(), 1.0) << shape.coordinate;
  }
}

TEST(FreeShapes, OfOneCoordinateSayWhereTheirBinsLie) {
  const auto shapes = free_shapes({sine()});
  ASSERT_EQ(shapes.front().coordinate, "position");
  ASSERT_EQ(shapes.front().at.size(), 12U);
  EXPECT_TRUE(std::is_sorted(shapes.front().at.begin(), shapes.front().at.end()));
  EXPECT_NEAR(shapes.front().at.front(), -shapes.front().at.back(), 0.02);
}

TEST(FreeShapes, OfAMotionThatStandsAreOfThePastAlone) {
  Motion still = sine();
  for (auto* of :
       {&still.position_m, &still.speed_m_per_s, &still.acceleration_m_per_s2, &still.input_N}) {
    of->setConstant(0.1);
  }
  const auto shapes = free_shapes({still});
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].coordinate, "time");
  EXPECT_EQ(shapes[1].coordinate, "the motion before");
  EXPECT_EQ(shapes[2].coordinate, "the work before");
}

TEST(FreeShapes, OfPlaceTimesSpeedAreProductsOfWavesAndPowers) {
  const Motion motion = sine();
  const auto shapes = free_shapes({motion});
  const FreeShape& smooth = named(shapes, "position times speed");
  ASSERT_EQ(smooth.columns, 18);
  const double x = 0.5 * (motion.position_m[1234] + 1);
  const double v = motion.speed_m_per_s[1234] / 0.7;
  EXPECT_NEAR(smooth.force(1, motion)[1234], std::cos(6.2831853 * x) * v, 1e-4);
  EXPECT_NEAR(smooth.force(6, motion)[1234], std::cos(3.14159265 * x) * v * v, 1e-4);
}

// The force of a Maxwell part at constant speed: 1 - exp(-t / memory). Friction that warms: the
// same, against the motion.
TEST(FreeShapes, OfThePastAreLowPasses) {
  Motion steady = sine();
  steady.speed_m_per_s.setConstant(-0.5);
  const auto shapes = free_shapes({steady});
  const FreeShape& spring = named(shapes, "the motion before");
  const FreeShape& warmth = named(shapes, "the work before");
  ASSERT_EQ(spring.columns, 6);
  ASSERT_EQ(warmth.columns, 3);
  EXPECT_NEAR(spring.force(3, steady)[800], -(1 - std::exp(-1.0)), 2e-3);
  EXPECT_NEAR(spring.force(5, steady)[3200], -(1 - std::exp(-1.0)), 2e-3);
  EXPECT_NEAR(warmth.force(2, steady)[10000], -(1 - std::exp(-1.0)), 2e-3);
}

// Of a sine from the middle: 0.02 ... 0.4 of the stroke of 2 m, each way back from its end. A
// reversal shorter than 4 mm is none.
TEST(FreeShapes, OfTheWaySinceAReversalFadeWithIt) {
  Motion motion = sine();
  motion.position_m.array() += 1e-3 * (200 * motion.time_s.array()).sin();
  const auto shapes = free_shapes({motion});
  const FreeShape& since = named(shapes, "the way since the reversal");
  ASSERT_EQ(since.columns, 5);
  const auto expect_at = [&](Eigen::Index i, double way_m, double direction) {
    EXPECT_NEAR(since.force(0, motion)[i], direction * std::exp(-way_m / 0.04), 0.08) << i;
    EXPECT_NEAR(since.force(4, motion)[i], direction * std::exp(-way_m / 0.8), 0.01) << i;
  };
  expect_at(1000, std::sin(0.7), 1);
  expect_at(2400, 1 - std::sin(0.7 * 2.4), -1);  // 0.16 s behind the end, 6 mm
  expect_at(4000, 1 - std::sin(0.7 * 4), -1);
  expect_at(8000, 1 + std::sin(0.7 * 8), 1);
}

}  // namespace
}  // namespace towbench::study::diagnose
