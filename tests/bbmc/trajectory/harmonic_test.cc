#include "bbmc/system/trajectory/harmonic.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/bbmc/trajectory/profile_checks.h"

namespace towbench::bbmc {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// (4.22)-(4.24) as printed, with the C library.
TEST(Harmonic, WithoutRampsItIsTheSinusoidOfTheThesis) {
  const double amplitude_m = 0.1;
  const double period_s = 2.5;
  const auto motion = Harmonic::make({.start_m = 0.4,
                                      .amplitude_m = amplitude_m,
                                      .phase = {.frequency_hz = 1 / period_s, .turns = 3}});
  ASSERT_TRUE(motion);
  EXPECT_DOUBLE_EQ(motion->duration_s(), 7.5);
  const double theta_0 = 0.4 + amplitude_m;
  for (double t = 0; t < 7.5; t += 0.013) {
    const double w = kTwoPi / period_s;
    const Reference reference = motion->at(t);
    ASSERT_NEAR(reference.position_m, theta_0 - amplitude_m * std::cos(w * t), 1e-15);
    ASSERT_NEAR(reference.velocity_m_per_s, amplitude_m * w * std::sin(w * t), 2e-15);
    ASSERT_NEAR(reference.acceleration_m_per_s2, amplitude_m * w * w * std::cos(w * t), 4e-15);
  }
}

TEST(Harmonic, ACircleWithRampsStaysACircleAndItsVelocityNeverJumps) {
  const double radius_m = 0.20;
  const PhaseRampParameters phase{.frequency_hz = 1.0 / 7, .turns = 1, .ramp_s = 1, .wait_s = 0.5};
  const auto y = Harmonic::make({.start_m = 1.0, .amplitude_m = radius_m, .phase = phase});
  const auto x = Harmonic::make(
      {.start_m = 0.3, .amplitude_m = radius_m, .starting_phase_turns = 0.25, .phase = phase});
  ASSERT_TRUE(y);
  ASSERT_TRUE(x);
  EXPECT_DOUBLE_EQ(y->duration_s(), 0.5 + 7 + 1);
  double fastest = 0;
  for (double t = 0; t < 9; t += 0.01) {
    const Reference at_y = y->at(t);
    const Reference at_x = x->at(t);
    ASSERT_NEAR(std::hypot(at_y.position_m - 1.2, at_x.position_m - 0.3), radius_m, 1e-15);
    fastest = std::fmax(fastest, std::hypot(at_y.velocity_m_per_s, at_x.velocity_m_per_s));
  }
  EXPECT_NEAR(fastest, radius_m * kTwoPi / 7, 1e-12);
  // Tangential and centripetal part together.
  const double rate = kTwoPi / 7;
  const double angular = kTwoPi / 7 * std::numbers::pi / 2;
  const double bound = radius_m * std::hypot(rate * rate, angular);
  testing::expect_consistent(*y, radius_m * rate, bound);
  testing::expect_consistent(*x, radius_m * rate, bound);
  EXPECT_DOUBLE_EQ(y->at(100).position_m, 1.0);
  EXPECT_NEAR(x->at(100).position_m, 0.3, 1e-16);
}

TEST(Harmonic, TooFewTurnsForTheRampsKeepTheAngularAccelerationAndLowerThePeak) {
  const PhaseRampParameters wanted{.frequency_hz = 0.5, .turns = 0.25, .ramp_s = 2};
  const auto full = PhaseRamp::make({.frequency_hz = 0.5, .turns = 10, .ramp_s = 2});
  const auto phase = PhaseRamp::make(wanted);
  ASSERT_TRUE(full);
  ASSERT_TRUE(phase);
  EXPECT_LT(phase->peak_frequency_hz(), 0.5);
  const auto steepest = [](const PhaseRamp& ramp) {
    double most = 0;
    for (double t = 0; t < ramp.duration_s(); t += 1e-3) {
      most = std::fmax(most, std::fabs(ramp.at(t).frequency_rate_hz_per_s));
    }
    return most;
  };
  EXPECT_NEAR(steepest(*phase), steepest(*full), 1e-5);
  EXPECT_EQ(phase->at(1e6).turns, 0.25);
}

TEST(Harmonic, PhaseIsTheIntegralOfFrequency) {
  const auto phase =
      PhaseRamp::make({.frequency_hz = 0.15, .turns = 2, .ramp_s = 1.3, .wait_s = 1});
  ASSERT_TRUE(phase);
  double turns = 0;
  constexpr double kStep_s = 1e-4;
  for (int i = 0; i < 170'000; ++i) {
    turns += kStep_s * phase->at((i + 0.5) * kStep_s).frequency_hz;
    ASSERT_NEAR(phase->at((i + 1) * kStep_s).turns, turns, 1e-8);
  }
  EXPECT_NEAR(turns, 2, 1e-8);
}

TEST(Harmonic, SaysHowFarAndHowFastItWillGo) {
  const auto motion = Harmonic::make({.start_m = 0.5,
                                      .amplitude_m = -0.1,
                                      .starting_phase_turns = 0.25,
                                      .phase = {.frequency_hz = 0.3, .turns = 2}});
  ASSERT_TRUE(motion);
  double low = 1;
  double high = 0;
  double fastest = 0;
  for (double t = 0; t < motion->duration_s(); t += 1e-3) {
    const Reference reference = motion->at(t);
    low = std::fmin(low, reference.position_m);
    high = std::fmax(high, reference.position_m);
    fastest = std::fmax(fastest, std::fabs(reference.velocity_m_per_s));
  }
  EXPECT_NEAR(motion->lowest_m(), low, 1e-6);
  EXPECT_NEAR(motion->highest_m(), high, 1e-6);
  EXPECT_NEAR(motion->peak_speed_m_per_s(), fastest, 1e-6);
}

TEST(Harmonic, RefusesWhatIsNotAMotion) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const HarmonicParameters good{.amplitude_m = 0.1, .phase = {.frequency_hz = 1, .turns = 1}};
  EXPECT_TRUE(Harmonic::make(good));
  const auto refused = [&](auto change) {
    HarmonicParameters wanted = good;
    change(wanted);
    return !Harmonic::make(wanted);
  };
  EXPECT_TRUE(refused([](auto& w) { w.amplitude_m = 0; }));
  EXPECT_TRUE(refused([&](auto& w) { w.amplitude_m = nan; }));
  EXPECT_TRUE(refused([&](auto& w) { w.start_m = nan; }));
  EXPECT_TRUE(refused([&](auto& w) { w.starting_phase_turns = nan; }));
  EXPECT_TRUE(refused([](auto& w) { w.phase.frequency_hz = 0; }));
  EXPECT_TRUE(refused([](auto& w) { w.phase.turns = -1; }));
  EXPECT_TRUE(refused([&](auto& w) { w.phase.ramp_s = nan; }));
  EXPECT_TRUE(refused([](auto& w) { w.phase.wait_s = -1; }));
}

}  // namespace
}  // namespace towbench::bbmc
