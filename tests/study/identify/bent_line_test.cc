// A bent line against points whose bends are known.
#include "study/identify/bent_line.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::study::identify {
namespace {

double tent(double x) {
  return x < 1.976 ? 2.0 + x : 2.0 + 1.976 - 0.7 * (x - 1.976);
}

std::vector<LinePoint> points_of(double (*law)(double), double noise) {
  core::Random random(7);
  std::vector<LinePoint> points;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.3 + 3.4 * i / 59;
    points.push_back({x, law(x) + noise * (2 * random.uniform() - 1), noise / std::sqrt(3.0)});
  }
  return points;
}

TEST(BentLine, FindsTheOneBendThatThereIs) {
  const auto line = fit_bent_line(points_of(tent, 1e-2), 8);
  ASSERT_EQ(line.x.size(), 3U);
  EXPECT_NEAR(line.x[1], 1.976, 0.01);
  for (const double x : {0.4, 1.2, 1.976, 2.9, 3.6}) {
    EXPECT_NEAR(line.at(x), tent(x), 6e-3) << x;
  }
}

TEST(BentLine, BendsNotWhereThePointsAreStraight) {
  const auto line = fit_bent_line(points_of([](double x) { return 3 - 0.2 * x; }, 1e-2), 8);
  ASSERT_EQ(line.x.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(line.y[i], 3 - 0.2 * line.x[i], 3 * line.standard_error[i]);
  }
}

// What is said of the points is their weight; how sure the line is they show themselves.
TEST(BentLine, IsAsSureAsItsPointsAgree) {
  auto points = points_of([](double x) { return 3 - 0.2 * x; }, 1e-2);
  const auto right = fit_bent_line(points, 0);
  for (auto& point : points) {
    point.standard_error *= 5;
  }
  const auto doubted = fit_bent_line(points, 0);
  EXPECT_NEAR(doubted.standard_error[0], right.standard_error[0], 1e-9);
  // Of the value at the end of a line: 2 sigma / sqrt(n).
  EXPECT_NEAR(right.standard_error[0], 2 * 1e-2 / std::sqrt(3.0 * 60), 3e-4);
}

TEST(BentLine, FollowsACurveWithSeveralBends) {
  const auto curve = [](double x) { return std::sin(2 * x); };
  const auto line = fit_bent_line(points_of(curve, 1e-3), 8);
  EXPECT_GE(line.x.size(), 5U);
  EXPECT_LT(line.residual_rms, 0.03);
}

TEST(BentLine, NeedsPointsInMoreThanOnePlace) {
  EXPECT_TRUE(fit_bent_line({{0, 1, 1}, {1, 2, 1}}, 3).x.empty());
  EXPECT_TRUE(fit_bent_line(std::vector<LinePoint>(9, LinePoint{2, 1, 1}), 3).x.empty());
}

}  // namespace
}  // namespace towbench::study::identify
