// Dry friction: it sticks for good, lets go at its level, and always takes energy.
#include <cmath>

#include <gtest/gtest.h>

#include "emulator/plant/friction_law.h"
#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

TEST(Friction, HoldsALoadBelowBreakAwayForAnHourWithoutMovingAtAll) {
  const AxisParameters axis = nominal_y();
  Bench bench(axis, 1.0);
  bench.ask_current(axis, 0.9 * axis.friction.breakaway_Nm * (1 - axis.friction.carriage_share) /
                              axis.torque_constant_Nm_per_A);
  bench.input.carriage_force_N =
      0.9 * axis.friction.breakaway_Nm * axis.friction.carriage_share / radius_of(axis);
  bench.run(1.0);
  const auto before = bench.plant.state();
  bench.run(3600.0);
  const auto after = bench.plant.state();
  EXPECT_EQ(after.motor_angle_rad, before.motor_angle_rad);
  EXPECT_EQ(after.carriage_m, before.carriage_m);
  EXPECT_EQ(after.carriage_speed_m_per_s, 0.0);
}

// Raises the current by `step_A` a tick until the motor moves; the current at which it does.
double break_away_current_A(const AxisParameters& axis, double step_A, double sign) {
  Bench bench(axis, 1.0);
  const auto start = bench.plant.state();
  for (int k = 1;; ++k) {
    bench.ask_current(axis, sign * k * step_A);
    bench.tick();
    if (bench.plant.state().motor_angle_rad != start.motor_angle_rad) {
      return std::abs(bench.plant.state().current_A);
    }
  }
}

TEST(Friction, ARigidAxisBreaksAwayAtItsLevelToATenthOfAPercentEitherWay) {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  const double expected_A = axis.friction.breakaway_Nm / axis.torque_constant_Nm_per_A;
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NEAR(break_away_current_A(axis, 2e-5, sign), expected_A, 1e-3 * expected_A);
  }
}

TEST(Friction, BreakAwayRisesByThePositionFrictionOfThePlace) {
  AxisParameters axis = nominal_y();
  axis.elasticity.rigid = true;
  const double extra_Nm = 1.6e-3 * 1.0 / 1.976;  // starts at 1.0 m
  const double expected_A = (axis.friction.breakaway_Nm + extra_Nm) / axis.torque_constant_Nm_per_A;
  EXPECT_NEAR(break_away_current_A(axis, 2e-5, 1.0), expected_A, 1e-3 * expected_A);
}

TEST(Friction, AnElasticAxisMovesItsMotorAtTheMotorsShareAndItsCarriageAtTheWhole) {
  const AxisParameters axis{};
  const double motor_A = (1 - axis.friction.carriage_share) * axis.friction.breakaway_Nm /
                         axis.torque_constant_Nm_per_A;
  EXPECT_NEAR(break_away_current_A(axis, 2e-6, 1.0), motor_A, 1e-3 * motor_A);

  Bench bench(axis, 1.0);
  // 2 mA/s: slow enough for the transmission to follow.
  for (int k = 1; bench.plant.forces().carriage_sticks; ++k) {
    bench.ask_current(axis, k * 2e-7);
    bench.tick();
  }
  const double whole_A = axis.friction.breakaway_Nm / axis.torque_constant_Nm_per_A;
  EXPECT_NEAR(bench.plant.forces().transmission_force_N * radius_of(axis),
              axis.friction.carriage_share * axis.friction.breakaway_Nm,
              1e-3 * axis.friction.breakaway_Nm);
  EXPECT_NEAR(bench.plant.state().current_A, whole_A, 0.02 * whole_A);  // the motor lurches
}

TEST(Friction, SticksAgainAfterASlipAndCarriesTheLoadFromThen) {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  Bench bench(axis, 1.0);
  bench.ask_current(axis, 0.3);
  bench.run(0.1);
  EXPECT_GT(bench.plant.state().motor_speed_rad_per_s, 10.0);
  const double hold_A = 0.5 * axis.friction.breakaway_Nm / axis.torque_constant_Nm_per_A;
  bench.ask_current(axis, hold_A);
  bench.run(2.0);
  EXPECT_EQ(bench.plant.state().motor_speed_rad_per_s, 0.0);
  EXPECT_TRUE(bench.plant.forces().motor_sticks);
  EXPECT_NEAR(bench.plant.forces().motor_friction_Nm, -hold_A * axis.torque_constant_Nm_per_A,
              1e-12);
}

TEST(Friction, StribeckCurvesAreThoseOfTheThesis) {
  const emulator::StribeckCurve gaussian(emulator::StribeckForm::kGaussian);
  const emulator::StribeckCurve lorentz(emulator::StribeckForm::kLorentz);
  for (double ratio = 0; ratio < 8; ratio += 0.0037) {
    ASSERT_NEAR(gaussian(ratio), std::exp(-ratio * ratio), 3e-8);  // (3.25)
    ASSERT_NEAR(lorentz(ratio), 1 / (1 + ratio * ratio), 1e-15);   // (3.26)
  }
  EXPECT_EQ(gaussian(0.0), 1.0);
}

TEST(Friction, ATinyNumberOfTicksShowsAChatterFreeStickSlip) {
  const AxisParameters axis = nominal_y();
  Bench bench(axis, 1.0);
  std::size_t most = 0;
  for (int k = 0; k < 100000; ++k) {
    bench.ask_current(axis, 0.25 * std::sin(2 * M_PI * 0.2 * k * 1e-4));
    bench.tick();
    most = std::max(most, bench.segments.size());
  }
  EXPECT_LE(most, 4U);  // a tick holds few events, never a burst of them
}

}  // namespace
}  // namespace towbench::tests
