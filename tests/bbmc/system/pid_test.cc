#include "bbmc/system/pid.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace towbench::bbmc {
namespace {

constexpr PidGains kGains{
    .proportional_Nm_per_rad = 0.1, .integral_Nm_per_rad_s = 0.5, .derivative_Nm_s_per_rad = 2e-3};

TEST(Pid, IsEquation4_12) {
  Pid pid(kGains);
  double integral = 0;
  for (int k = 1; k <= 100; ++k) {
    const double error = 0.01 * k;
    integral += error * 1e-3;
    const double torque = pid.update({.error_rad = error,
                                      .speed_error_rad_per_s = 3.0,
                                      .feed_forward_Nm = 0.001,
                                      .limit_Nm = 1.0,
                                      .step_s = 1e-3});
    EXPECT_NEAR(torque, 0.1 * error + 0.5 * integral + 2e-3 * 3.0 + 0.001, 1e-15);
  }
}

TEST(Defect6AntiWindup, TheOutputNeverLeavesItsLimitAndSaysWhenItIsThere) {
  Pid pid(kGains);
  for (const double error : {50.0, -50.0}) {
    const double torque = pid.update({.error_rad = error, .limit_Nm = 0.09, .step_s = 1e-3});
    EXPECT_EQ(torque, error > 0 ? 0.09 : -0.09);
    EXPECT_TRUE(pid.saturated());
  }
  EXPECT_NE(pid.update({.error_rad = 0.1, .limit_Nm = 0.09, .step_s = 1e-3}), 0.09);
  EXPECT_FALSE(pid.saturated());
}

// A mass that cannot follow for a second, then can: the overshoot that a wound-up integral causes
// must not be there. The independent truth is the same loop without any integral.
TEST(Defect6AntiWindup, ALongSaturationLeavesNoOvershootBehind) {
  const auto overshoot = [](const PidGains& gains) {
    constexpr double kInertia = 1.7e-5;
    constexpr double kStep_s = 1e-3;
    Pid pid(gains);
    double angle = 0;
    double speed = 0;
    double highest = 0;
    for (int k = 0; k < 5'000; ++k) {
      const double torque = pid.update({.error_rad = 300.0 - angle,
                                        .speed_error_rad_per_s = -speed,
                                        .limit_Nm = 0.02,
                                        .step_s = kStep_s});
      speed += (torque - 1e-5 * speed) / kInertia * kStep_s;
      angle += speed * kStep_s;
      highest = std::max(highest, angle);
    }
    return highest - 300.0;
  };
  PidGains without = {
      .proportional_Nm_per_rad = 0.01, .integral_Nm_per_rad_s = 0, .derivative_Nm_s_per_rad = 2e-3};
  PidGains with = without;
  with.integral_Nm_per_rad_s = 0.02;
  EXPECT_LT(overshoot(with), overshoot(without) + 20.0);

  // What happens without the repair: S of the original grows all the time.
  double wound_up = 0;
  double angle = 0;
  double speed = 0;
  double highest = 0;
  for (int k = 0; k < 5'000; ++k) {
    wound_up += 0.02 * (300.0 - angle) * 1e-3;
    const double torque = std::clamp(0.01 * (300.0 - angle) + wound_up - 2e-3 * speed, -0.02, 0.02);
    speed += (torque - 1e-5 * speed) / 1.7e-5 * 1e-3;
    angle += speed * 1e-3;
    highest = std::max(highest, angle);
  }
  EXPECT_GT(highest - 300.0, overshoot(with) + 20.0);
}

TEST(Pid, AChangeOfGainsInMotionMovesNothingAtOnce) {
  Pid pid(kGains);
  const Pid::Input input{
      .error_rad = 0.2, .speed_error_rad_per_s = 4.0, .limit_Nm = 1.0, .step_s = 1e-3};
  double before = 0;
  for (int k = 0; k < 10; ++k) {
    before = pid.update(input);
  }
  pid.set_gains({.proportional_Nm_per_rad = 0.3,
                 .integral_Nm_per_rad_s = 0.0,
                 .derivative_Nm_s_per_rad = 1e-3});
  EXPECT_NEAR(pid.update(input), before, 1e-12);
}

TEST(Pid, FeedForwardIsTheRigidModelRunForwards) {
  FeedForward model;
  EXPECT_EQ(feed_forward_torque_Nm(model, 100, 1000), 0.0);  // off by default
  model.enabled = true;
  EXPECT_NEAR(feed_forward_torque_Nm(model, 100, 1000), 1.714e-5 * 1000 + 1.106e-5 * 100 + 2.26e-3,
              1e-15);
  EXPECT_NEAR(feed_forward_torque_Nm(model, -100, 0), -1.106e-3 - 2.26e-3, 1e-15);
  EXPECT_EQ(feed_forward_torque_Nm(model, 0, 0), 0.0);
}

TEST(Defect14SiGains, BbmcGainsConvertToTheSameDutyForTheSameError) {
  // BBMC 0.5, Y: 0.008 % per count, 2e-6 % per count and sample, 0.005 % per count/s.
  const AxisConfiguration y;
  const PidGains gains = gains_from_bbmc_units(y, 1000.0, 0.008, 2e-6, 0.005);
  Pid pid(gains);
  double sum = 0;
  for (int k = 0; k < 50; ++k) {
    const double error_counts = 120;
    const double speed_error_counts_per_s = -900;
    sum += error_counts;
    const double duty_pct = 0.008 * error_counts + 2e-6 * sum + 0.005 * speed_error_counts_per_s;
    const double torque =
        pid.update({.error_rad = error_counts * y.rad_per_count(),
                    .speed_error_rad_per_s = speed_error_counts_per_s * y.rad_per_count(),
                    .limit_Nm = 1.0,
                    .step_s = 1e-3});
    EXPECT_NEAR(torque / y.drive.full_duty_torque_Nm() * 100.0, duty_pct, 1e-9);
  }
  // docs/reference/constants.md: 1 % duty = 9.88e-4 N m.
  EXPECT_NEAR(y.drive.full_duty_torque_Nm() / 100.0, 9.88e-4, 1e-6);
}

}  // namespace
}  // namespace towbench::bbmc
