// The weight of a joint, against the physical pendulum in closed form: period of small and of large
// swings, energy, where it hangs, what holds it.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

constexpr double kFullTurn_rad = 2 * std::numbers::pi;
constexpr double kWeight_Nm = 3.0;       // m g l
constexpr double kInertia_kg_m2 = 0.15;  // at the joint, motor and gear included

// A joint behind a gear of 50, without any loss: its position is an angle.
AxisParameters free_joint(double zero_at_deg = 0) {
  AxisParameters joint = linear_axis();
  joint.viscous_friction_Nm_s_per_rad = 0;
  joint.elasticity.rigid = true;
  joint.gear_ratio = 50;
  joint.output_radius_m = 1;
  joint.inertia_kg_m2 = kInertia_kg_m2 / (50.0 * 50.0);
  joint.disturbances.gravity = {.torque_Nm = kWeight_Nm, .zero_at_deg = zero_at_deg};
  return joint;
}

Bench swinging(const AxisParameters& joint, double at_rad) {
  EXPECT_EQ(emulator::inconsistency(joint), nullptr);
  Bench bench(joint, at_rad);
  bench.input.amplifier_enabled = false;
  return bench;
}

// From rest at an end to the fourth passage of the bottom, which is 7/4 of a period.
double period_s(Bench& bench, double bottom_rad) {
  double before = bench.plant.state().carriage_m - bottom_rad;
  int passages = 0;
  for (int k = 1; k < 200'000; ++k) {
    bench.tick();
    const double now = bench.plant.state().carriage_m - bottom_rad;
    if ((before > 0) != (now > 0) && ++passages == 4) {
      return (k - now / (now - before)) * 1e-4 / 1.75;
    }
    before = now;
  }
  ADD_FAILURE() << "it does not swing";
  return 0;
}

// T = 4 sqrt(J / m g l) K(sin(amplitude / 2)); the small swing's is 2 pi sqrt(J / m g l).
double pendulum_period_s(double amplitude_rad) {
  return 4 * std::sqrt(kInertia_kg_m2 / kWeight_Nm) *
         std::comp_ellint_1(std::sin(0.5 * amplitude_rad));
}

TEST(Weight, ASmallSwingTakesThePeriodOfTheLinearPendulum) {
  Bench bench = swinging(free_joint(), 1e-3);
  const double linear_s = kFullTurn_rad * std::sqrt(kInertia_kg_m2 / kWeight_Nm);
  EXPECT_NEAR(period_s(bench, 0), linear_s, 1e-6 * linear_s);
}

class LargeSwing : public ::testing::TestWithParam<double> {};

TEST_P(LargeSwing, TakesThePeriodOfTheEllipticIntegral) {
  const double amplitude_rad = GetParam() * kFullTurn_rad / 360;
  Bench bench = swinging(free_joint(), amplitude_rad);
  const double exact_s = pendulum_period_s(amplitude_rad);
  EXPECT_GT(exact_s, 1.01 * pendulum_period_s(1e-3));
  EXPECT_NEAR(period_s(bench, 0), exact_s, 1e-6 * exact_s);
}

INSTANTIATE_TEST_SUITE_P(Degrees, LargeSwing, ::testing::Values(30.0, 90.0, 150.0, 175.0));

TEST(Weight, ZeroMayStandAnywhereFromHanging) {
  Bench bench = swinging(free_joint(35), 0);
  const double exact_s = pendulum_period_s(35 * kFullTurn_rad / 360);
  EXPECT_NEAR(period_s(bench, -35 * kFullTurn_rad / 360), exact_s, 1e-6 * exact_s);
}

TEST(Weight, OnlyLendsEnergyThroughWholeTurns) {
  Bench bench = swinging(free_joint(), 0);
  bench.input.carriage_force_N = 6.0;
  bench.run(0.8);
  bench.input.carriage_force_N = 0;
  bench.tick();
  const auto energy_J = [&] {
    const auto s = bench.plant.state();
    return 0.5 * kInertia_kg_m2 * s.carriage_speed_m_per_s * s.carriage_speed_m_per_s -
           kWeight_Nm * std::cos(s.carriage_m);
  };
  const double at_start_J = energy_J();
  ASSERT_GT(at_start_J, kWeight_Nm);  // it turns over
  const double from_rad = bench.plant.state().carriage_m;
  for (int k = 0; k < 100; ++k) {
    bench.run(0.1);
    ASSERT_NEAR(energy_J(), at_start_J, 1e-5 * kWeight_Nm);
  }
  EXPECT_GT(bench.plant.state().carriage_m - from_rad, 5 * kFullTurn_rad);
}

// Behind an elastic gear the motor swings along; both bodies and the spring keep their energy.
TEST(Weight, KeepsItsEnergyBehindAnElasticGear) {
  AxisParameters joint = free_joint();
  joint.elasticity = {.rigid = false, .resonance_Hz = 30, .damping_ratio = 0};
  joint.rotor_inertia_kg_m2 = 0.3 * joint.inertia_kg_m2;
  Bench bench = swinging(joint, 2.0);
  const double n = joint.gear_ratio;
  const double load_kg_m2 = 0.7 * kInertia_kg_m2;
  const double mobility = 1 / (0.3 * kInertia_kg_m2) + 1 / load_kg_m2;
  const double spring_Nm_per_rad = std::pow(kFullTurn_rad * 30, 2) / mobility;
  const auto energy_J = [&] {
    const auto s = bench.plant.state();
    const double motor = s.motor_speed_rad_per_s / n;
    const double twist = s.motor_angle_rad / n - s.carriage_m;
    return 0.5 * 0.3 * kInertia_kg_m2 * motor * motor +
           0.5 * load_kg_m2 * s.carriage_speed_m_per_s * s.carriage_speed_m_per_s +
           0.5 * spring_Nm_per_rad * twist * twist - kWeight_Nm * std::cos(s.carriage_m);
  };
  const double at_start_J = energy_J();
  for (int k = 0; k < 50; ++k) {
    bench.run(0.1);
    ASSERT_NEAR(energy_J(), at_start_J, 1e-4 * kWeight_Nm);
  }
}

// Break-away S at the motor holds up to n S at the joint.
TEST(Weight, IsHeldByBreakAwayUntilItsSineIsTooLarge) {
  AxisParameters joint = free_joint();
  joint.coulomb_friction_Nm = 0.02;
  joint.friction.breakaway_Nm = 0.03;
  const double limit_rad = std::asin(50 * 0.03 / kWeight_Nm);
  for (const double share : {0.98, 1.02}) {
    Bench bench = swinging(joint, share * limit_rad);
    bench.run(0.5);
    const bool stands = bench.plant.state().carriage_m == share * limit_rad;
    EXPECT_EQ(stands, share < 1) << share;
    if (stands) {
      EXPECT_NEAR(bench.plant.forces().standing_force_N, -kWeight_Nm * std::sin(share * limit_rad),
                  1e-12);
    }
  }
}

}  // namespace
}  // namespace towbench::tests
