// Estimators on data whose truth is known in closed form.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/random.h"
#include "study/identify/drive_constants.h"
#include "study/identify/estimate.h"
#include "study/identify/friction_law.h"
#include "study/identify/long_run_covariance.h"

namespace towbench::study::identify {
namespace {

TEST(DriveConstants, AreTheSlopesWhateverFrictionAndBiasAre) {
  constexpr double kRadius = 1.43e-3;
  std::vector<PushedRun> runs;
  for (const bool up : {true, false}) {
    for (const double force : {15.0, -15.0}) {
      const double friction = up ? 3e-3 : -2.5e-3;
      const double current = (friction - kRadius * force) / 0.03;
      runs.push_back({.towards_max = up,
                      .current_A = {current + 0.005, 1e-5},
                      .force_N = {force - 0.02, 1e-4},
                      .command_V = {current / 0.4, 1e-5}});
    }
  }
  const auto found = find_drive_constants(runs, kRadius);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.torque_constant_Nm_per_A, 0.03, 1e-9);
  EXPECT_NEAR(found.amplifier_gain_A_per_V, 0.4, 1e-9);
  EXPECT_GT(found.torque_constant_standard_error, 0);
}

// Friction of the place would look like noise of the current, twenty times what is there.
TEST(DriveConstants, AreAsSureAsStretchesOfTheSameWayAgree) {
  constexpr double kRadius = 1.43e-3;
  core::Random random(3);
  std::vector<PushedRun> runs;
  for (int stretch = 0; stretch < 10; ++stretch) {
    for (const bool up : {true, false}) {
      for (const double force : {15.0, -15.0}) {
        const double friction = (up ? 1 : -1) * (2e-3 + 1e-4 * stretch * stretch);
        const double current = (friction - kRadius * force) / 0.03 + 1e-4 * random.gaussian();
        runs.push_back({.towards_max = up,
                        .stretch = stretch,
                        .current_A = {current, 0.02},
                        .force_N = {force, 0.02},
                        .command_V = {current / 0.4, 0.02}});
      }
    }
  }
  const auto found = find_drive_constants(runs, kRadius);
  ASSERT_TRUE(found.found);
  // 1e-4 A over sqrt(40) x 0.715 A of current from the push.
  EXPECT_NEAR(found.torque_constant_standard_error / 0.03, 1e-4 / std::sqrt(40.0) / 0.715, 1e-5);
  EXPECT_NEAR(found.torque_per_volt_standard_error, found.torque_constant_standard_error / 0.03,
              1e-9);
  EXPECT_NEAR(found.torque_constant_Nm_per_A, 0.03, 3 * found.torque_constant_standard_error);
  EXPECT_LT(found.amplifier_gain_standard_error, 1e-9);  // the current is the command's
}

// Of a push that moves the carriage to where friction is 2e-5 N m less or more, which one direction
// gains and the other loses.
TEST(DriveConstants, DoNotSeeWhereThePushMovesTheCarriage) {
  constexpr double kRadius = 1.43e-3;
  std::vector<PushedRun> runs;
  for (int stretch = 0; stretch < 3; ++stretch) {
    for (const double sign : {1.0, -1.0}) {
      for (const double force : {15.0, -15.0}) {
        const double friction = sign * (2e-3 + 2e-5 * force / 15);
        const double current = (friction - kRadius * force) / 0.03;
        runs.push_back({.towards_max = sign > 0,
                        .stretch = stretch,
                        .current_A = {current, 0},
                        .force_N = {force, 0},
                        .command_V = {current / 0.4, 0}});
      }
    }
  }
  const auto found = find_drive_constants(runs, kRadius);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.torque_constant_Nm_per_A, 0.03, 1e-9);
  EXPECT_LT(found.torque_constant_standard_error, 1e-9);
}

TEST(DriveConstants, KnowTheTorqueOfACommandPastANoisyCurrentMonitor) {
  constexpr double kRadius = 1.43e-3;
  core::Random random(8);
  std::vector<PushedRun> runs;
  for (int stretch = 0; stretch < 10; ++stretch) {
    for (const bool up : {true, false}) {
      for (const double force : {15.0, -15.0}) {
        const double current = ((up ? 1 : -1) * 2e-3 - kRadius * force) / 0.03;
        runs.push_back({.towards_max = up,
                        .stretch = stretch,
                        .current_A = {current + 0.01 * random.gaussian(), 0},
                        .force_N = {force, 0},
                        .command_V = {current / 0.4, 0}});
      }
    }
  }
  const auto found = find_drive_constants(runs, kRadius);
  ASSERT_TRUE(found.found);
  EXPECT_GT(found.torque_constant_standard_error / 0.03, 1e-3);
  EXPECT_NEAR(found.torque_constant_Nm_per_A * found.amplifier_gain_A_per_V, 0.03 * 0.4, 1e-9);
  EXPECT_LT(found.torque_per_volt_standard_error, 1e-9);
}

TEST(WindowMeans, OfASwingAreItsMiddle) {
  // Two and a half periods of an amplitude of 1 about 3, which a plain mean is 0.13 off.
  std::vector<double> column;
  for (int k = 0; k < 1000; ++k) {
    column.push_back(3 + std::sin(2 * std::numbers::pi * 2.5 * k / 1000));
  }
  EXPECT_NEAR(smooth_mean_of(column, 0, 1000).value, 3, 0.03);
  EXPECT_GT(std::fabs(mean_of(column, 0, 1000).value - 3), 0.1);
}

TEST(DriveConstants, AreNotFoundWithoutAPush) {
  std::vector<PushedRun> runs(4);
  for (auto& run : runs) {
    run.current_A = {0.1, 1e-4};
  }
  EXPECT_FALSE(find_drive_constants(runs, 1e-3).found);
}

TEST(FrictionLaw, OfGaussianFormIsFoundAndTakenForWhatItIs) {
  std::vector<SteadyRun> runs;
  for (double w = 0.7; w < 300; w *= 1.4) {
    for (const double sign : {1.0, -1.0}) {
      const double torque = 2e-3 + 1e-3 * std::exp(-(w / 6) * (w / 6)) + 1e-5 * w;
      runs.push_back(
          {.speed_rad_per_s = sign * w, .torque_Nm = sign * torque, .standard_error_Nm = 1e-6});
    }
  }
  const auto law = fit_friction_law(runs, 10);
  ASSERT_TRUE(law.found);
  EXPECT_FALSE(law.lorentz);
  EXPECT_NEAR(law.coulomb_Nm, 2e-3, 1e-6);
  EXPECT_NEAR(law.excess_Nm, 1e-3, 1e-6);
  EXPECT_NEAR(law.stribeck_rad_per_s, 6, 1e-2);
  EXPECT_NEAR(law.viscous_Nm_s_per_rad, 1e-5, 1e-8);
}

TEST(LongRunCovariance, OfAnAutoregressiveSeriesIsItsClosedForm) {
  // x_t = a x_(t-1) + e: the variance of the sum over n samples is n / (1 - a)^2.
  core::Random random(5);
  constexpr Eigen::Index kSamples = 40000;
  constexpr double kMemory = 0.8;
  Eigen::MatrixXd x(kSamples, 1);
  double last = 0;
  for (Eigen::Index t = 0; t < kSamples; ++t) {
    last = kMemory * last + random.gaussian();
    x(t, 0) = last;
  }
  const double expected = static_cast<double>(kSamples) / ((1 - kMemory) * (1 - kMemory));
  EXPECT_NEAR(long_run_covariance(x, 100)(0, 0) / expected, 1, 0.15);
  EXPECT_LT(long_run_covariance(x, 0)(0, 0) / expected, 0.2);  // without lags: far too sure
}

TEST(Estimate, SurvivesItsOwnJson) {
  const Estimates before{{.quantity = "breakaway_Nm",
                          .axis = "y",
                          .value = 3.7e-3,
                          .low = 3.6e-3,
                          .high = 3.8e-3,
                          .unit = "N m",
                          .rests_on = "ramps",
                          .procedure = "EXP-OL-1",
                          .at = 0.5}};
  const auto after = estimates_from_json(to_json(before));
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].value, before[0].value);
  EXPECT_EQ(after[0].at, before[0].at);
  EXPECT_EQ(after[0].rests_on, before[0].rests_on);
  EXPECT_EQ(find(after, "breakaway_Nm", "y"), nullptr);  // a point of a map is no single value
}

}  // namespace
}  // namespace towbench::study::identify
