// The nonlinear disturbance observer against its closed form: of a constant load the error falls by
// exp(-int L dt), and along a constant acceleration a that integral is (p(w_1) - p(w_0)) / (J a).
#include "bbmc/system/nonlinear_observer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/configuration.h"
#include "bbmc/system/control_law.h"
#include "tests/bbmc/support/tracking.h"
#include "tests/support/allocation_guard.h"

namespace towbench::bbmc {
namespace {

const NonlinearObserverSettings kSettings{.enabled = true,
                                          .gain_rad_per_s = 10,
                                          .inertia_kg_m2 = 1.7e-5,
                                          .rest_speed_rad_per_s = 3,
                                          .limit_Nm = 0.1};
constexpr double kLoad_Nm = 2e-3;

// p(w) / J as the header has it, written again.
double auxiliary_per_inertia(double w) {
  return 10 * w * w * w / (w * w + 9);
}

// f(w) of some machine: break-away, Stribeck and viscous.
double friction_Nm(double w) {
  return (2.3e-3 + 1.4e-3 / (1 + w * w / 36)) * std::tanh(w / 0.3) + 1.1e-5 * w;
}

// Error left after the speed has gone from `from` to `to` at `acceleration`, in steps of 50 us; the
// axis truly has f(w) + d.
double error_after_ramp_Nm(double from, double to, double acceleration, double modelled_share) {
  constexpr double kStep_s = 5e-5;
  NonlinearObserver observer(kSettings);
  const int steps = static_cast<int>(std::lround((to - from) / acceleration / kStep_s));
  double estimate_Nm = 0;
  for (int k = 0; k <= steps; ++k) {
    const double w = from + acceleration * kStep_s * k;
    const double torque_Nm = kSettings.inertia_kg_m2 * acceleration + friction_Nm(w) + kLoad_Nm;
    estimate_Nm = observer.update(torque_Nm, w, modelled_share * friction_Nm(w), kStep_s);
  }
  return kLoad_Nm - estimate_Nm;
}

TEST(NonlinearObserver, ForgetsItsErrorAsTheIntegralOfItsGainSays) {
  for (const double acceleration : {20.0, 100.0}) {
    for (const double to : {2.0, 6.0, 40.0}) {
      const double exponent =
          (auxiliary_per_inertia(to) - auxiliary_per_inertia(0.5)) / acceleration;
      const double expected_Nm = kLoad_Nm * std::exp(-exponent);
      EXPECT_NEAR(error_after_ramp_Nm(0.5, to, acceleration, 1), expected_Nm,
                  2e-3 * kLoad_Nm + 5e-3 * expected_Nm)
          << to << " rad/s at " << acceleration;
    }
  }
}

// What is not modelled is in the estimate: with half of the friction the other half is a load.
TEST(NonlinearObserver, TakesForALoadWhatItsFrictionLacks) {
  const double left_Nm = error_after_ramp_Nm(1, 200, 20, 0.5);
  EXPECT_NEAR(left_Nm, -0.5 * friction_Nm(200), 0.02e-3);
}

// At rest dry friction holds whatever is asked of the motor: that is no load.
TEST(NonlinearObserver, LearnsNothingAtRest) {
  NonlinearObserver observer(kSettings);
  for (int k = 0; k < 5000; ++k) {
    observer.update(3e-3, 0, 0, 1e-3);
  }
  EXPECT_EQ(observer.estimate_Nm(), 0);
  EXPECT_EQ(observer.gain_per_s(0), 0);
}

TEST(NonlinearObserver, HasTheDerivativeOfItsAuxiliaryFunctionForAGain) {
  NonlinearObserver observer(kSettings);
  for (const double w : {-50.0, -3.0, -0.4, 0.1, 1.0, 5.2, 80.0}) {
    const double slope = (auxiliary_per_inertia(w + 1e-4) - auxiliary_per_inertia(w - 1e-4)) / 2e-4;
    EXPECT_NEAR(observer.gain_per_s(w), slope, 1e-5) << w;
    EXPECT_GE(observer.gain_per_s(w), 0);
    EXPECT_LE(observer.gain_per_s(w), 1.1251 * kSettings.gain_rad_per_s);
  }
}

TEST(NonlinearObserver, KeepsItsLimitAndLeavesItAtOnce) {
  auto settings = kSettings;
  settings.limit_Nm = 1e-3;
  NonlinearObserver observer(settings);
  const tests::AllocationGuard guard;
  for (int k = 0; k < 3000; ++k) {
    EXPECT_LE(std::fabs(observer.update(0.05, 50, 0, 1e-3)), 1e-3 * (1 + 1e-12));
  }
  EXPECT_LT(observer.update(-0.05, 50, 0, 1e-3), 1e-3 * (1 - 1e-3));
}

// The law adds what the observer estimates, and the observer leaves out what the law adds by
// itself.
TEST(NonlinearObserver, GivesTheLawWhatFrictionCompensationLeavesOver) {
  AxisConfiguration axis;
  axis.gains = {
      .proportional_Nm_per_rad = 0, .integral_Nm_per_rad_s = 0, .derivative_Nm_s_per_rad = 0};
  axis.friction.enabled = true;
  axis.nonlinear_observer.enabled = true;
  ControlLaw law(axis);
  const double speed = 100;
  const double friction = friction_torque_Nm(axis.friction, speed);
  double wanted = 0;
  for (int k = 0; k < 3000; ++k) {
    wanted = law.torque_Nm({.reference = {.velocity_m_per_s = speed * axis.metres_per_motor_rad()},
                            .velocity_m_per_s = speed * axis.metres_per_motor_rad(),
                            .applied_Nm = friction + 1.5e-3,
                            .limit_Nm = 1,
                            .step_s = 1e-3});
  }
  EXPECT_NEAR(law.disturbance_Nm(), 1.5e-3, 1e-6);
  EXPECT_NEAR(wanted, friction + 1.5e-3, 1e-6);
}

// docs/measurements/observers.md: where friction falls with speed it holds the motor against the
// carriage that sticks and slips; and it cannot beat the encoder's step, 0.6 um.
TEST(NonlinearObserver, HoldsTheMotorNearerToItsReferenceThanTheIntegral) {
  const tests::Law plain{.name = "PID"};
  const tests::Law observed{.name = "", .friction = true, .nonlinear_observer = true};
  for (const double speed_m_per_s : {0.005, 0.02, 0.1}) {
    const auto pid = tests::measure_trapezoid(plain, core::Axis::kY, speed_m_per_s);
    const auto with = tests::measure_trapezoid(observed, core::Axis::kY, speed_m_per_s);
    ASSERT_TRUE(pid.sound && with.sound) << speed_m_per_s;
    EXPECT_LT(with.rms_error_m, 0.35 * pid.rms_error_m) << speed_m_per_s;
    EXPECT_GT(with.rms_error_m, 0.6e-6) << speed_m_per_s;
  }
  EXPECT_TRUE(tests::measure_trapezoid(observed, core::Axis::kX, 0.1).sound);
}

TEST(NonlinearObserver, IsRefusedBesideTheLinearOne) {
  Configuration configuration;
  auto& axis = configuration.axes[core::Axis::kY];
  axis.nonlinear_observer.enabled = true;
  EXPECT_EQ(inconsistency(configuration), nullptr);
  axis.disturbance_observer.enabled = true;
  EXPECT_NE(inconsistency(configuration), nullptr);
}

}  // namespace
}  // namespace towbench::bbmc
