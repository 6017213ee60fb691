#include "emulator/water/body_drag.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::emulator {
namespace {

using core::Axis;

PlaneVector in_plane(double x, double y) {
  PlaneVector v;
  v[Axis::kX] = x;
  v[Axis::kY] = y;
  return v;
}

PlaneVector random_velocity(core::Random& random) {
  const double speed = 0.6 * random.uniform();
  const double direction = 2.0 * std::numbers::pi * random.uniform();
  return in_plane(speed * std::cos(direction), speed * std::sin(direction));
}

constexpr WaterBodyParameters kCylinder{
    .in_water = true, .quadratic_drag_N_s2_per_m2 = 8.78, .linear_drag_N_s_per_m = 0.3};

// (8.1) and (3.8) on each component of a straight, oblique tow.
TEST(BodyDrag, BrakesARoundBodyExactlyAgainstItsMotion) {
  const BodyDrag drag(kCylinder);
  core::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const PlaneVector v = random_velocity(random);
    const double speed = std::hypot(v[Axis::kX], v[Axis::kY]);
    const PlaneVector force = drag(v);
    const double size = 8.78 * speed * speed + 0.3 * speed;
    ASSERT_NEAR(force[Axis::kX], -size * v[Axis::kX] / speed, 1e-13);
    ASSERT_NEAR(force[Axis::kY], -size * v[Axis::kY] / speed, 1e-13);
  }
}

TEST(BodyDrag, IsTheSameForARoundBodyAtAnyYaw) {
  WaterBodyParameters turned = kCylinder;
  turned.yaw_deg = 37.0;
  const PlaneVector v = in_plane(0.2, -0.4);
  for (const Axis axis : core::kPlanarAxes) {
    EXPECT_NEAR(BodyDrag(kCylinder)(v)[axis], BodyDrag(turned)(v)[axis], 1e-15);
  }
}

// A vector law: turning body and motion together turns the force with them.
TEST(BodyDrag, TurnsWithBodyAndMotionTurnedTogether) {
  core::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    WaterBodyParameters body = kCylinder;
    body.across_drag_ratio = 6.0 * random.uniform();
    body.yaw_deg = 360.0 * (random.uniform() - 0.5);
    WaterBodyParameters turned = body;
    const double turn_deg = 180.0 * (random.uniform() - 0.5);
    turned.yaw_deg += turn_deg;
    const double c = std::cos(turn_deg * std::numbers::pi / 180.0);
    const double s = std::sin(turn_deg * std::numbers::pi / 180.0);
    const auto rotated = [&](const PlaneVector& v) {
      return in_plane(c * v[Axis::kX] - s * v[Axis::kY], s * v[Axis::kX] + c * v[Axis::kY]);
    };
    const PlaneVector v = random_velocity(random);
    const PlaneVector expected = rotated(BodyDrag(body)(v));
    const PlaneVector force = BodyDrag(turned)(rotated(v));
    ASSERT_NEAR(force[Axis::kX], expected[Axis::kX], 1e-13);
    ASSERT_NEAR(force[Axis::kY], expected[Axis::kY], 1e-13);
  }
}

// EXP-3: towed towards +Y with its nose turned by beta to the left.
TEST(BodyDrag, OfAnElongatedBodyAtAnAngleIsTheSumOfAlongAndAcross) {
  constexpr double kSpeed = 0.4;
  constexpr double kRatio = 5.0;
  for (int beta_deg = -180; beta_deg <= 180; beta_deg += 15) {
    WaterBodyParameters body{.in_water = true,
                             .quadratic_drag_N_s2_per_m2 = 2.0,
                             .across_drag_ratio = kRatio,
                             .yaw_deg = static_cast<double>(beta_deg)};
    const PlaneVector force = BodyDrag(body)(in_plane(0.0, kSpeed));
    const double beta = beta_deg * std::numbers::pi / 180.0;
    const double along = std::cos(beta) * std::cos(beta) + kRatio * std::sin(beta) * std::sin(beta);
    EXPECT_NEAR(force[Axis::kY], -2.0 * kSpeed * kSpeed * along, 1e-14) << beta_deg;
    // With the nose to the left (-X) the water on its right flank pushes it to the left.
    EXPECT_NEAR(force[Axis::kX],
                -2.0 * kSpeed * kSpeed * (kRatio - 1.0) * std::sin(beta) * std::cos(beta), 1e-14)
        << beta_deg;
  }
}

TEST(BodyDrag, NeverDrivesABody) {
  core::Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const BodyDrag drag({.in_water = true,
                         .quadratic_drag_N_s2_per_m2 = 10.0 * random.uniform(),
                         .linear_drag_N_s_per_m = random.uniform(),
                         .across_drag_ratio = 10.0 * random.uniform(),
                         .yaw_deg = 360.0 * random.uniform()});
    const PlaneVector v = random_velocity(random);
    const PlaneVector force = drag(v);
    ASSERT_LE(force[Axis::kX] * v[Axis::kX] + force[Axis::kY] * v[Axis::kY], 0.0);
  }
}

TEST(BodyDrag, IsNoneOutOfTheWaterAndNoneAtRest) {
  WaterBodyParameters dry = kCylinder;
  dry.in_water = false;
  for (const Axis axis : core::kPlanarAxes) {
    EXPECT_EQ(BodyDrag(dry)(in_plane(0.3, 0.5))[axis], 0.0);
    EXPECT_EQ(BodyDrag(kCylinder)(in_plane(0.0, 0.0))[axis], 0.0);
  }
}

}  // namespace
}  // namespace towbench::emulator
