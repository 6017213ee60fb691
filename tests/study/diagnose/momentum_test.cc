// The first fit without a simulation, on a motion whose force is known in closed form.
#include "study/diagnose/momentum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/study/diagnose/generator/two_link_arm.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

// x = A (1 - cos w t) / 2; each input is the force in the middle of its period.
Run swinging_body() {
  constexpr double kAmplitude_m = 0.6;
  constexpr double kSpeed_rad_per_s = 2 * std::numbers::pi * 0.4;
  study::diagnose::Run run;
  run.period_s = 1e-3;
  run.position_m.resize(20'000);
  run.input_N.resize(20'000);
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    const double phase = kSpeed_rad_per_s * run.period_s * static_cast<double>(i);
    const double mid = phase + 0.5 * kSpeed_rad_per_s * run.period_s;
    const double v = 0.5 * kAmplitude_m * kSpeed_rad_per_s * std::sin(mid);
    const double a = 0.5 * kAmplitude_m * kSpeed_rad_per_s * kSpeed_rad_per_s * std::cos(mid);
    run.position_m[i] = 0.5 * kAmplitude_m * (1 - std::cos(phase));
    run.input_N[i] = 8 * a + 5 * v + 2 * (v > 0 ? 1 : -1) + 0.4;
  }
  run.missing.assign(20'000, 0);
  return run;
}

TEST(Momentum, HasTheFourParametersOfTheClosedForm) {
  const Momentum fit = fit_momentum({swinging_body()}, false, 0);
  EXPECT_NEAR(fit.mass_kg, 8, 0.08);
  EXPECT_NEAR(fit.viscous_N_s_per_m, 5, 0.1);
  EXPECT_NEAR(fit.coulomb_N, 2, 0.04);
  EXPECT_NEAR(fit.bias_N, 0.4, 0.02);
  EXPECT_GT(fit.explained, 0.999);
}

TEST(Momentum, ExplainsLessWhereTheInputIsLate) {
  const study::diagnose::Run run = swinging_body();
  // A sine that is late is a sum of its speed and acceleration; dry friction is not.
  const double aligned = fit_momentum({run}, false, 0).explained;
  EXPECT_LT(1 - aligned, 0.5 * (1 - fit_momentum({run}, false, 0.2).explained));
}

// 8 kg without friction, pushed out and back by 10 N and by 2 N; the drive makes 4 N at most.
study::diagnose::Run body_of_a_weak_drive() {
  constexpr double kMost_N = 4;
  study::diagnose::Run run;
  run.period_s = 1e-3;
  run.position_m.resize(16'000);
  run.input_N.resize(16'000);
  double v = 0;
  double x = 0;
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    const Eigen::Index quarter = i % 2000 / 500;
    const double sign = quarter == 0 || quarter == 3 ? 1 : -1;
    run.position_m[i] = x;
    run.input_N[i] = sign * (i / 2000 % 2 == 0 ? 10 : 2);
    const double a = std::clamp(run.input_N[i], -kMost_N, kMost_N) / 8;
    x += (v + 0.5 * a * run.period_s) * run.period_s;
    v += a * run.period_s;
  }
  run.missing.assign(16'000, 0);
  return run;
}

TEST(Momentum, HasTheMassThatADriveMovesWhichMakesLessThanItIsAskedFor) {
  const study::diagnose::Run run = body_of_a_weak_drive();
  EXPECT_GT(fit_momentum({run}, false, 0).mass_kg, 16);
  const Momentum fit = fit_momentum_of_drive({run}, false);
  EXPECT_DOUBLE_EQ(fit.most_N, 4.5);
  EXPECT_NEAR(fit.mass_kg, 8, 8 * 0.125);
}

TEST(Momentum, LimitsNoInputThatIsExplainedWithoutIt) {
  EXPECT_EQ(fit_momentum_of_drive({swinging_body()}, false).most_N, kUnlimited_N);
}

// Of a joint that another moves more than its own drive does.
TEST(Momentum, HasWhatTheOtherJointDoesBesideIt) {
  TwoLinkArm arm;
  arm.second_share = 0.3;
  arm.weight_2_Nm = 12;
  const ArmLog log = make_arm_log(arm, 6);
  const auto vector_of = [](const std::vector<double>& values) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
  };
  study::diagnose::Run run;
  run.period_s = arm.period_s;
  run.position_m = vector_of(log.q2_rad);
  run.input_N = vector_of(log.torque2_Nm);
  EXPECT_LT(fit_momentum({run}, true, 0).explained, 0.9);
  run.others.push_back({vector_of(log.q1_rad), true});
  const Momentum fit = fit_momentum({run}, true, 0);
  EXPECT_GT(fit.explained, 0.99);
  EXPECT_NEAR(fit.mass_kg, arm.d_kg_m2, 0.05 * arm.d_kg_m2);
  EXPECT_NEAR(fit.coulomb_N, arm.coulomb_Nm, 0.15 * arm.coulomb_Nm);
}

}  // namespace
}  // namespace towbench::tests
