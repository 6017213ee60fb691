#include "bbmc/system/trajectory/trapezoid.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/bbmc/trajectory/profile_checks.h"

namespace towbench::bbmc {
namespace {

constexpr TrapezoidParameters kAsymmetric{.start_m = 0.2,
                                          .distance_m = 1.1,
                                          .speed_m_per_s = 0.4,
                                          .acceleration_time_s = 0.3,
                                          .deceleration_time_s = 0.7,
                                          .wait_s = 0.5};

// (4.21) as corrected: the area under the velocity trapezoid.
double area_m(const Trapezoid& t) {
  return t.peak_velocity_m_per_s() *
         (t.acceleration_time_s() / 2 + t.steady_time_s() + t.deceleration_time_s() / 2);
}

TEST(Trapezoid, PositionIsTheIntegralOfVelocityAndNothingJumps) {
  const auto profile = Trapezoid::make(kAsymmetric);
  ASSERT_TRUE(profile);
  testing::expect_consistent(*profile, 0.4, 0.4 / 0.3);
}

TEST(Trapezoid, RunsBackwardsJustAsWell) {
  TrapezoidParameters wanted = kAsymmetric;
  wanted.distance_m = -1.1;
  const auto profile = Trapezoid::make(wanted);
  ASSERT_TRUE(profile);
  testing::expect_consistent(*profile, 0.4, 0.4 / 0.3);
  EXPECT_DOUBLE_EQ(profile->at(100).position_m, 0.2 - 1.1);
}

TEST(Trapezoid, EndsWhereTheAreaUnderItsVelocityEndsAndTakesTheTimeOf4_16) {
  const auto profile = Trapezoid::make(kAsymmetric);
  ASSERT_TRUE(profile);
  EXPECT_NEAR(area_m(*profile), 1.1, 1e-15);
  EXPECT_DOUBLE_EQ(profile->duration_s(), 0.5 + 0.3 + 0.7 + profile->steady_time_s());
  EXPECT_DOUBLE_EQ(profile->at(profile->duration_s()).position_m, 1.3);
  EXPECT_EQ(profile->at(profile->duration_s()).velocity_m_per_s, 0);
  EXPECT_EQ(profile->at(1e9).position_m, profile->at(profile->duration_s()).position_m);
}

TEST(Trapezoid, RestsDuringItsWait) {
  const auto profile = Trapezoid::make(kAsymmetric);
  ASSERT_TRUE(profile);
  for (const double time_s : {-1.0, 0.0, 0.25, 0.499999}) {
    EXPECT_EQ(profile->at(time_s).position_m, 0.2);
    EXPECT_EQ(profile->at(time_s).velocity_m_per_s, 0);
  }
  EXPECT_GT(profile->at(0.51).velocity_m_per_s, 0);
}

// Each formula of the print, as printed, against the same area: none of them is the profile.
TEST(Trapezoid, ThePrintedFormulasAreNotThisProfile) {
  const auto profile = Trapezoid::make(kAsymmetric);
  ASSERT_TRUE(profile);
  const double w = profile->peak_velocity_m_per_s();
  const double t_acc = profile->acceleration_time_s();
  const double t_ss = profile->steady_time_s();
  const double t_dec = profile->deceleration_time_s();
  // (4.21): 3/2 t_ss. Off by w (t_acc + t_ss) / 2.
  EXPECT_GT(std::fabs(w * (t_acc + 1.5 * t_ss + t_dec / 2) - 1.1), 0.1);
  // (4.17): t from 0, so the first branch starts with a jump when there is a wait.
  EXPECT_GT(std::fabs(w / (2 * t_acc) * 0.5 * 0.5), 0.1);
  // (4.18): the sign inside the constant; right only if it meets the cruise at its end.
  const double tau = t_acc + t_ss;
  const double linear_and_square = tau * (1 + (t_acc + t_ss) / t_dec) - tau * tau / (2 * t_dec);
  const double printed = linear_and_square - (t_acc * t_dec - tau * tau) / (2 * t_dec);
  const double corrected = linear_and_square - (t_acc * t_dec + tau * tau) / (2 * t_dec);
  EXPECT_GT(std::fabs(w * printed - w * (tau - t_acc / 2)), 0.1);
  EXPECT_NEAR(w * corrected, w * (tau - t_acc / 2), 1e-14);
  // (4.19): the last branch without t would never come to rest.
  EXPECT_GT(std::fabs(w * (1 - (t_ss + t_acc) / t_dec)), 0.1);
}

// The corrected (4.17)-(4.19), written out, against the profile.
TEST(Trapezoid, AgreesWithTheCorrectedFormulas) {
  const auto profile = Trapezoid::make(kAsymmetric);
  ASSERT_TRUE(profile);
  const double w = 0.4;
  const double t_acc = 0.3;
  const double t_dec = 0.7;
  const double t_ss = profile->steady_time_s();
  for (double tau = 1e-4; tau < t_acc + t_ss + t_dec; tau += 1e-3) {
    double x = w * tau * tau / (2 * t_acc);
    double v = w * tau / t_acc;
    if (tau >= t_acc + t_ss) {
      x = w * (tau * (1 + (t_acc + t_ss) / t_dec) - tau * tau / (2 * t_dec) -
               (t_acc * t_dec + (t_acc + t_ss) * (t_acc + t_ss)) / (2 * t_dec));
      v = w * (1 - (tau - t_acc - t_ss) / t_dec);
    } else if (tau >= t_acc) {
      x = w * (tau - t_acc / 2);
      v = w;
    }
    const Reference reference = profile->at(0.5 + tau);
    ASSERT_NEAR(reference.position_m, 0.2 + x, 1e-14) << tau;
    ASSERT_NEAR(reference.velocity_m_per_s, v, 1e-14) << tau;
  }
}

TEST(Defect7, ADistanceTooShortForTheSpeedGivesATriangleWithTheSameAccelerations) {
  TrapezoidParameters wanted = kAsymmetric;
  wanted.distance_m = 0.05;  // the ramps alone would take 0.2 m
  const auto profile = Trapezoid::make(wanted);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->steady_time_s(), 0);
  // Energy form: v^2 / (2 a) + v^2 / (2 d) = distance.
  const double a = 0.4 / 0.3;
  const double d = 0.4 / 0.7;
  EXPECT_NEAR(profile->peak_velocity_m_per_s(), std::sqrt(2 * 0.05 / (1 / a + 1 / d)), 1e-15);
  EXPECT_NEAR(profile->peak_velocity_m_per_s() / profile->acceleration_time_s(), a, 1e-14);
  EXPECT_NEAR(profile->peak_velocity_m_per_s() / profile->deceleration_time_s(), d, 1e-14);
  testing::expect_consistent(*profile, profile->peak_velocity_m_per_s(), a);
  EXPECT_DOUBLE_EQ(profile->at(profile->duration_s()).position_m, 0.25);
}

TEST(Trapezoid, TheDistanceWhereTrapezoidAndTriangleMeetIsNeitherLongerNorShorter) {
  TrapezoidParameters wanted = kAsymmetric;
  wanted.distance_m = 0.2;
  const auto meeting = Trapezoid::make(wanted);
  wanted.distance_m = 0.2 * (1 - 1e-9);
  const auto below = Trapezoid::make(wanted);
  ASSERT_TRUE(meeting);
  ASSERT_TRUE(below);
  EXPECT_NEAR(meeting->duration_s(), below->duration_s(), 1e-8);
}

TEST(Trapezoid, ItsIntegralOfPositionIsTheIntegralOfItsPosition) {
  for (const double distance_m : {1.1, -1.1, 0.01}) {
    TrapezoidParameters wanted = kAsymmetric;
    wanted.distance_m = distance_m;
    const auto profile = Trapezoid::make(wanted);
    ASSERT_TRUE(profile);
    double sum = 0;
    constexpr double kStep_s = 1e-4;
    for (int i = 0; i < 60'000; ++i) {  // midpoint rule: error h^2 a / 24 a second
      sum += kStep_s * profile->at((i + 0.5) * kStep_s).position_m;
      if (i % 1000 == 0) {
        ASSERT_NEAR(profile->position_integral_m_s((i + 1) * kStep_s), sum, 1e-8);
      }
    }
  }
}

TEST(Trapezoid, RefusesWhatIsNotAProfile) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto refused = [](auto change) {
    TrapezoidParameters wanted = kAsymmetric;
    change(wanted);
    const auto profile = Trapezoid::make(wanted);
    return !profile && profile.error() == core::ErrorCode::kRequestBadArgument;
  };
  EXPECT_TRUE(refused([](auto& w) { w.distance_m = 0; }));
  EXPECT_TRUE(refused([](auto& w) { w.speed_m_per_s = 0; }));
  EXPECT_TRUE(refused([](auto& w) { w.speed_m_per_s = -0.4; }));
  EXPECT_TRUE(refused([](auto& w) { w.acceleration_time_s = 0; }));
  EXPECT_TRUE(refused([](auto& w) { w.deceleration_time_s = -1; }));
  EXPECT_TRUE(refused([](auto& w) { w.wait_s = -1e-9; }));
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_TRUE(refused([&](auto& w) { w.start_m = bad; }));
    EXPECT_TRUE(refused([&](auto& w) { w.distance_m = bad; }));
    EXPECT_TRUE(refused([&](auto& w) { w.speed_m_per_s = bad; }));
    EXPECT_TRUE(refused([&](auto& w) { w.acceleration_time_s = bad; }));
    EXPECT_TRUE(refused([&](auto& w) { w.deceleration_time_s = bad; }));
    EXPECT_TRUE(refused([&](auto& w) { w.wait_s = bad; }));
  }
}

}  // namespace
}  // namespace towbench::bbmc
