// What friction may do beyond Coulomb, break-away and Stribeck, each against its closed form.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

AxisParameters rigid_axis() {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  axis.hard_ends.fitted = false;
  return axis;
}

// Raises the current from 0 by `step_A` a tick until friction lets the motor go.
double sliding_from_A(Bench& bench, const AxisParameters& axis, double step_A) {
  for (int k = 1;; ++k) {
    bench.ask_current(axis, k * step_A);
    bench.tick();
    if (!bench.plant.forces().motor_sticks) {
      return bench.plant.state().current_A;
    }
  }
}

double steady_speed_rad_per_s(const AxisParameters& axis, double current_A) {
  Bench bench(axis, 1.0);
  bench.ask_current(axis, current_A);
  bench.run(60.0);
  return bench.plant.state().motor_speed_rad_per_s;
}

TEST(FrictionOptions, AnAsymmetricAxisBreaksAwayAtEachDirectionsOwnLevel) {
  AxisParameters axis = rigid_axis();
  axis.friction.options.asymmetry = {.coulomb = 0.2, .breakaway = 0.15};
  for (const double sign : {1.0, -1.0}) {
    Bench bench(axis, 1.0);
    const double expected_A =
        sign * axis.friction.breakaway_Nm * (1 + sign * 0.15) / axis.torque_constant_Nm_per_A;
    EXPECT_NEAR(sliding_from_A(bench, axis, sign * 2e-5), expected_A, 1e-3 * std::abs(expected_A));
  }
}

TEST(FrictionOptions, AnAsymmetricAxisRunsAtEachDirectionsOwnSpeed) {
  AxisParameters axis = rigid_axis();
  axis.friction.options.asymmetry = {.coulomb = 0.2, .breakaway = 0.2, .viscous = -0.3};
  for (const double sign : {1.0, -1.0}) {
    const double w = steady_speed_rad_per_s(axis, sign * 0.2);
    // K_T i = C (1 +- a_C) + B (1 +- a_B) |w|; the current loop follows a steady current exactly.
    const double expected =
        (axis.torque_constant_Nm_per_A * 0.2 - axis.coulomb_friction_Nm * (1 + sign * 0.2)) /
        (axis.viscous_friction_Nm_s_per_rad * (1 - sign * 0.3));
    EXPECT_NEAR(sign * w, expected, 1e-4 * expected) << sign;
  }
}

TEST(FrictionOptions, ALoadedCarriageHoldsByItsShareOfTheTransmissionForceMore) {
  AxisParameters axis;
  axis.friction.carriage_share = 1.0;
  axis.friction.options.load_ratio = 0.2;
  Bench bench(axis, 1.0);
  for (int k = 1; bench.plant.forces().carriage_sticks; ++k) {
    bench.ask_current(axis, k * 2e-7);
    bench.tick();
  }
  // F = S / r + 0.2 F
  const double expected_N = axis.friction.breakaway_Nm / radius_of(axis) / (1 - 0.2);
  EXPECT_NEAR(bench.plant.forces().transmission_force_N, expected_N, 1e-3 * expected_N);
}

// A motor that hangs a force on the transmission: the torque at which it begins to lift, and to
// lower.
double torque_to_move_Nm(const AxisParameters& axis, double force_N, double sign) {
  Bench bench(axis, 1.0);
  const double hold_A = force_N * radius_of(axis) / axis.torque_constant_Nm_per_A;
  constexpr int kRampTicks = 20000;
  for (int k = 1; k <= kRampTicks; ++k) {  // slowly: the transmission must not swing
    bench.input.carriage_force_N = -force_N * k / kRampTicks;
    bench.ask_current(axis, hold_A * k / kRampTicks);
    bench.tick();
  }
  bench.run(5.0);
  EXPECT_NEAR(bench.plant.forces().transmission_force_N, force_N, 1e-6);
  EXPECT_TRUE(bench.plant.forces().motor_sticks);
  for (int k = 1; bench.plant.forces().motor_sticks; ++k) {
    bench.ask_current(axis, hold_A + sign * k * 1e-5);
    bench.tick();
  }
  return bench.plant.forces().motor_torque_Nm;
}

TEST(FrictionOptions, AGearOfEightyPercentNeedsAQuarterMoreToLiftAndAFifthLessToLower) {
  AxisParameters axis;
  axis.hard_ends.fitted = false;
  axis.friction.carriage_share = 0;
  axis.elasticity.damping_ratio = 0.5;
  axis.gear.efficiency = 0.8;
  const double load_Nm = 20.0 * radius_of(axis);
  const double s = axis.friction.breakaway_Nm;
  const double lift_Nm = s + load_Nm / 0.8;
  const double lower_Nm = 0.8 * load_Nm - s;
  EXPECT_NEAR(torque_to_move_Nm(axis, 20.0, 1.0), lift_Nm, 1e-3 * lift_Nm);
  EXPECT_NEAR(torque_to_move_Nm(axis, 20.0, -1.0), lower_Nm, 1e-3 * lower_Nm);
}

TEST(FrictionOptions, AGearPassesOnItsEfficiencyOfThePowerEitherWay) {
  AxisParameters axis = linear_axis();
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.gear.efficiency = 0.8;
  axis.elasticity.damping_ratio = 0.5;
  for (const double force_N : {-20.0, 20.0}) {  // against the motion, and with it
    Bench bench(axis, 0.0);
    const double ratio = force_N < 0 ? 1 / 0.8 : 0.8;
    bench.input.carriage_force_N = 5.0;
    bench.run(0.1);
    bench.input.carriage_force_N = force_N;
    // The current that balances the load, less what the gear takes: no acceleration is left.
    bench.ask_current(axis, -force_N * radius_of(axis) * ratio / axis.torque_constant_Nm_per_A);
    bench.run(1.0);
    const double before = bench.plant.state().motor_speed_rad_per_s;
    ASSERT_GT(before, 10.0);
    bench.run(1.0);
    // The current loop lags a moving motor, so the balance is not perfect: 0.1 % of the load.
    const double slack_Nm =
        axis.inertia_kg_m2 * (bench.plant.state().motor_speed_rad_per_s - before);
    EXPECT_LT(std::abs(slack_Nm), 1e-3 * 20.0 * radius_of(axis)) << force_N;
  }
}

TEST(FrictionOptions, FrictionWarmsByThePowerItDissipatesAndFallsByWhatItWarmed) {
  AxisParameters axis = rigid_axis();
  axis.friction.options.warming = {.depth = 1e-6, .full_power_W = 1.0, .time_constant_s = 7.0};
  Bench bench(axis, 1.0);
  bench.ask_current(axis, 0.15);
  bench.run(60.0);  // constant speed: constant power
  const double power_W =
      axis.coulomb_friction_Nm * bench.plant.state().motor_speed_rad_per_s;  // the dry part alone
  const double start = bench.plant.warmth();
  for (int k = 1; k <= 20; ++k) {
    bench.run(1.0);
    ASSERT_NEAR(bench.plant.warmth(), power_W + (start - power_W) * std::exp(-k / 7.0), 1e-4);
  }
  bench.input.amplifier_enabled = false;
  bench.run(30.0);
  const double warm = bench.plant.warmth();
  bench.run(7.0);
  EXPECT_NEAR(bench.plant.warmth(), warm * std::exp(-1.0), 1e-9);
}

TEST(FrictionOptions, AWarmAxisBreaksAwayEarlier) {
  AxisParameters axis = rigid_axis();
  axis.friction.options.warming = {.depth = 0.5, .full_power_W = 1.0, .time_constant_s = 1e4};
  Bench bench(axis, 1.0);
  bench.ask_current(axis, 1.0);
  bench.run(2000.0);
  bench.input.amplifier_enabled = false;
  bench.run(20.0);
  ASSERT_TRUE(bench.plant.forces().motor_sticks);
  ASSERT_GT(bench.plant.warmth(), 0.1);
  bench.input.amplifier_enabled = true;
  const double expected_A = axis.friction.breakaway_Nm *
                            (1 - 0.5 * std::min(bench.plant.warmth(), 1.0)) /
                            axis.torque_constant_Nm_per_A;
  EXPECT_NEAR(sliding_from_A(bench, axis, 2e-5), expected_A, 1e-3 * expected_A);
}

}  // namespace
}  // namespace towbench::tests
