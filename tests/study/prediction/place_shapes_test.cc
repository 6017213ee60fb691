// Forces by place against the sums of cosines that they stand for.
#include "study/prediction/place_shapes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;

constexpr double kLeast_m = -0.3;
constexpr double kMost_m = 1.1;

Scene scene_of(const study::diagnose::Run& run, const NominalModel& stated) {
  Scene scene(run, stated);
  scene.stroke_min_m = kLeast_m;
  scene.stroke_max_m = kMost_m;
  return scene;
}

// Of amplitudes 1 / (k + 1), k = 0, 1 ...
double sum_of_cosines(double x_m) {
  const double w = std::numbers::pi * (x_m - kLeast_m) / (kMost_m - kLeast_m);
  double sum = 0;
  for (int k = 1; k <= kShapes; ++k) sum += std::cos(k * w) / k;
  return sum;
}

PlaceShapes shapes_from(Key first) {
  Parameters p;
  for (int k = 0; k < kShapes; ++k) p[next(first, k)] = 1.0 / (k + 1);
  study::diagnose::Run run;
  run.period_s = 1e-3;
  run.input_N = Eigen::VectorXd::Zero(2);
  run.position_m = Eigen::VectorXd::Zero(2);
  const NominalModel stated;
  return {p, scene_of(run, stated)};
}

TEST(PlaceShapes, AreTheirSumsOfCosinesOnSlowAndFastWays) {
  for (const double step_m : {1e-5, 3e-3, 0.2}) {
    PlaceShapes shapes = shapes_from(Key::kPlaceForce1);
    for (double x = kMost_m; x > kLeast_m; x -= step_m) {
      shapes.go_to(x);
      ASSERT_NEAR(shapes.force_N(0.7), sum_of_cosines(x), 1e-6) << x << " by " << step_m;
    }
  }
}

TEST(PlaceShapes, StayBeyondTheSeenStrokeAsAtItsEnds) {
  PlaceShapes shapes = shapes_from(Key::kPlaceForce1);
  shapes.go_to(kMost_m + 0.3);
  EXPECT_NEAR(shapes.force_N(0), sum_of_cosines(kMost_m), 1e-9);
  shapes.go_to(kLeast_m - 0.3);
  EXPECT_NEAR(shapes.force_N(0), sum_of_cosines(kLeast_m), 1e-9);
}

TEST(PlaceShapes, ActBySpeedOrAsFriction) {
  PlaceShapes viscous = shapes_from(Key::kPlaceViscous1);
  viscous.go_to(0.2);
  EXPECT_NEAR(viscous.force_N(-2), -2 * sum_of_cosines(0.2), 1e-9);
  EXPECT_FALSE(viscous.have_friction());
  PlaceShapes friction = shapes_from(Key::kPlaceFriction1);
  friction.go_to(0.2);
  EXPECT_NEAR(friction.friction_N(), sum_of_cosines(0.2), 1e-9);
  EXPECT_FALSE(friction.have_force());
}

}  // namespace
}  // namespace towbench::tests
