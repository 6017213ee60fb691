#include "bbmc/system/trajectory/s_curve.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/bbmc/trajectory/profile_checks.h"

namespace towbench::bbmc {
namespace {

constexpr double kChainFrequency_hz = 9;
constexpr TrapezoidParameters kMove{
    .start_m = 0.3, .distance_m = 1.5, .speed_m_per_s = 0.4, .wait_s = 0.2};

// The swing left after the profile in an undamped oscillator at `frequency_hz` whose base follows
// it: m x'' = -k (x - reference), by its exact Duhamel integral of the acceleration.
template <typename Profile>
double residual_swing_m(const Profile& profile, double frequency_hz) {
  const double w = 2 * std::numbers::pi * frequency_hz;
  double sine = 0;
  double cosine = 0;
  constexpr double kStep_s = 2e-5;
  for (double t = kStep_s / 2; t < profile.duration_s(); t += kStep_s) {
    const double a = profile.at(t).acceleration_m_per_s2;
    sine += a * std::sin(w * t) * kStep_s;
    cosine += a * std::cos(w * t) * kStep_s;
  }
  return std::hypot(sine, cosine) / w;
}

TEST(SCurve, PositionIsTheIntegralOfVelocityAndNothingJumps) {
  const auto profile = SCurve::make(kMove, 1 / kChainFrequency_hz);
  ASSERT_TRUE(profile);
  testing::expect_consistent(*profile, 0.4, 0.4 / 0.3);
}

TEST(SCurve, JerkStaysBelowAccelerationOverWindow) {
  const double window_s = 1 / kChainFrequency_hz;
  const auto profile = SCurve::make(kMove, window_s);
  ASSERT_TRUE(profile);
  const double limit = 0.4 / 0.3 / window_s;
  constexpr double kStep_s = 1e-3;
  for (double t = 0; t < profile->duration_s(); t += kStep_s) {
    const double jerk =
        (profile->at(t + kStep_s).acceleration_m_per_s2 - profile->at(t).acceleration_m_per_s2) /
        kStep_s;
    ASSERT_LE(std::fabs(jerk), limit * (1 + 1e-9)) << t;
  }
}

TEST(SCurve, LeavesTheChainModeAtRestWhereATrapezoidLeavesItSwinging) {
  // 0.35 s is no multiple of the period, so the trapezoid does excite the mode.
  TrapezoidParameters move = kMove;
  move.acceleration_time_s = 0.35;
  move.deceleration_time_s = 0.41;
  const auto trapezoid = Trapezoid::make(move);
  const auto smooth = SCurve::make(move, 1 / kChainFrequency_hz);
  ASSERT_TRUE(trapezoid);
  ASSERT_TRUE(smooth);
  const double swing_m = residual_swing_m(*trapezoid, kChainFrequency_hz);
  EXPECT_GT(swing_m, 1e-4);
  EXPECT_LT(residual_swing_m(*smooth, kChainFrequency_hz), 2e-3 * swing_m);
  // And with the mode 5 % off, still twenty times less.
  EXPECT_LT(residual_swing_m(*smooth, 1.05 * kChainFrequency_hz),
            residual_swing_m(*trapezoid, 1.05 * kChainFrequency_hz) / 15);
}

TEST(SCurve, TakesTheWindowLongerAndEndsInTheSamePlace) {
  const auto profile = SCurve::make(kMove, 0.25);
  const auto base = Trapezoid::make(kMove);
  ASSERT_TRUE(profile);
  ASSERT_TRUE(base);
  EXPECT_DOUBLE_EQ(profile->duration_s(), base->duration_s() + 0.25);
  EXPECT_DOUBLE_EQ(profile->at(profile->duration_s()).position_m, 1.8);
  EXPECT_NEAR(profile->at(profile->duration_s() - 1e-9).position_m, 1.8, 1e-12);
  EXPECT_EQ(profile->at(0).position_m, 0.3);
}

TEST(SCurve, RefusesAWindowThatIsNone) {
  EXPECT_FALSE(SCurve::make(kMove, 0));
  EXPECT_FALSE(SCurve::make(kMove, -0.1));
  EXPECT_FALSE(SCurve::make(kMove, std::nan("")));
  EXPECT_FALSE(SCurve::make({.distance_m = 0}, 0.1));
}

}  // namespace
}  // namespace towbench::bbmc
