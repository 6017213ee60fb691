// Shapes without a law, on motions whose values are known.
#include "study/diagnose/free_shapes.h"

#include <cmath>

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

// The grid leaves out cells that the motion hardly enters.
TEST(FreeShapes, OfBinsCoverEachSampleOnce) {
  const Motion motion = sine();
  const auto shapes = free_shapes({motion});
  ASSERT_EQ(shapes.size(), 9U);
  for (const FreeShape& shape : shapes) {
    if (shape.coordinate == "position times speed") continue;
    if (shape.coordinate == "the motion before" || shape.coordinate == "the work before") continue;
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
  const FreeShape& smooth = shapes[shapes.size() - 3];
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
  const FreeShape& spring = shapes[shapes.size() - 2];
  const FreeShape& warmth = shapes.back();
  ASSERT_EQ(spring.columns, 6);
  ASSERT_EQ(warmth.columns, 3);
  EXPECT_NEAR(spring.force(3, steady)[800], -(1 - std::exp(-1.0)), 2e-3);
  EXPECT_NEAR(spring.force(5, steady)[3200], -(1 - std::exp(-1.0)), 2e-3);
  EXPECT_NEAR(warmth.force(2, steady)[10000], -(1 - std::exp(-1.0)), 2e-3);
}

}  // namespace
}  // namespace towbench::study::diagnose
