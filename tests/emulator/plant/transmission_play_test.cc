// Gear backlash, transmission slack and pre-tension: how far the motor turns for what force, and
// that a gap takes no energy.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

// All friction on the carriage, and more than any force used here: the motor turns alone.
AxisParameters held_carriage() {
  AxisParameters axis;
  axis.friction.carriage_share = 1.0;
  axis.friction.breakaway_Nm = 0.2;
  axis.elasticity.damping_ratio = 0.5;
  return axis;
}

double stiffness_N_per_m(const AxisParameters& axis) {
  const double r = radius_of(axis);
  const double motor_kg = axis.rotor_inertia_kg_m2 / (r * r);
  const double carriage_kg = (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / (r * r);
  return std::pow(2 * std::numbers::pi * axis.elasticity.resonance_Hz, 2) * motor_kg * carriage_kg /
         (motor_kg + carriage_kg);
}

// The stretch when the motor pulls with this force and has come to rest.
double stretch_under_m(const AxisParameters& axis, double force_N) {
  EXPECT_EQ(emulator::inconsistency(axis), nullptr);
  Bench bench(axis, 1.0);
  bench.ask_current(axis, force_N * radius_of(axis) / axis.torque_constant_Nm_per_A);
  bench.run(60.0);
  EXPECT_NEAR(bench.plant.state().motor_speed_rad_per_s, 0.0, 1e-9);
  EXPECT_NEAR(bench.plant.forces().transmission_force_N, force_N, 1e-6);
  EXPECT_TRUE(bench.plant.forces().carriage_sticks);
  return radius_of(axis) * bench.plant.state().motor_angle_rad - bench.plant.state().carriage_m;
}

TEST(TransmissionPlay, BacklashIsLostMotionOfItsAngleAtTheOutput) {
  AxisParameters axis = held_carriage();
  axis.gear.backlash_deg = 0.35;
  const double spring_m = 2.0 / stiffness_N_per_m(axis);
  const double lost_m = stretch_under_m(axis, 2.0) - stretch_under_m(axis, -2.0) - 2 * spring_m;
  EXPECT_NEAR(lost_m, 0.35 * std::numbers::pi / 180 * axis.output_radius_m, 1e-8);
  EXPECT_NEAR(lost_m, 0.31e-3, 0.01e-3);  // docs/reference/constants.md
}

TEST(TransmissionPlay, ASlackTransmissionHangsOnOneStrandOfHalfTheStiffness) {
  AxisParameters axis = held_carriage();
  axis.elasticity.slack_m = 2e-3;
  const double expected_m = 1e-3 + 3.0 / (0.5 * stiffness_N_per_m(axis));
  EXPECT_NEAR(stretch_under_m(axis, 3.0), expected_m, 1e-8);
  EXPECT_NEAR(stretch_under_m(axis, -3.0), -expected_m, 1e-8);
}

TEST(TransmissionPlay, APretensionedTransmissionSoftensWhenAStrandHasGoneSlack) {
  AxisParameters axis = held_carriage();
  axis.elasticity.pretension_N = 2.0;
  const double k = stiffness_N_per_m(axis);
  EXPECT_NEAR(stretch_under_m(axis, 3.0), 3.0 / k, 1e-8);  // below twice the pre-tension
  EXPECT_NEAR(stretch_under_m(axis, 6.0), 4.0 / k + 2.0 / (0.5 * k), 1e-8);
  EXPECT_NEAR(stretch_under_m(axis, -6.0), -(4.0 / k + 2.0 / (0.5 * k)), 1e-8);
}

TEST(TransmissionPlay, BacklashAndSlackAddUpToOneGap) {
  AxisParameters axis = held_carriage();
  axis.gear.backlash_deg = 0.35;
  axis.elasticity.slack_m = 1e-3;
  const double gap_m = 1e-3 + 0.35 * std::numbers::pi / 180 * axis.output_radius_m;
  EXPECT_NEAR(stretch_under_m(axis, 1.0), 0.5 * gap_m + 2.0 / stiffness_N_per_m(axis), 1e-8);
}

// Kinetic and elastic, of an axis without any loss that rattles in its gap.
TEST(TransmissionPlay, AGapWithoutLossesKeepsItsEnergyThroughEveryContact) {
  AxisParameters axis = linear_axis();
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.elasticity.damping_ratio = 0;
  axis.gear.backlash_deg = 0.35;
  axis.elasticity.pretension_N = 3.0;
  const double r = radius_of(axis);
  const double k = stiffness_N_per_m(axis);
  const double gap_m = 0.5 * 0.35 * std::numbers::pi / 180 * axis.output_radius_m;
  const double mass = (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / (r * r);
  Bench bench(axis, 0);
  bench.input = {.carriage_force_N = 20.0};
  bench.run(0.05);
  bench.input.carriage_force_N = 0;
  bench.tick();
  const auto energy_J = [&] {
    const auto s = bench.plant.state();
    const double pull_m = std::max(std::abs(r * s.motor_angle_rad - s.carriage_m) - gap_m, 0.0);
    const double both_m = std::min(pull_m, 2 * axis.elasticity.pretension_N / k);
    const double past_m = pull_m - both_m;  // on one strand
    return 0.5 * axis.rotor_inertia_kg_m2 * std::pow(s.motor_speed_rad_per_s, 2) +
           0.5 * mass * std::pow(s.carriage_speed_m_per_s, 2) + 0.5 * k * both_m * both_m +
           k * both_m * past_m + 0.25 * k * past_m * past_m;
  };
  const double before_J = energy_J();
  std::size_t events = 0;
  for (int n = 0; n < 200000; ++n) {
    bench.tick();
    events += bench.segments.size() - 1;
    ASSERT_NEAR(energy_J(), before_J, 1e-8 * before_J);
  }
  EXPECT_GT(events, 100U);
}

TEST(TransmissionPlay, AContactPushesAndNeverPulls) {
  AxisParameters axis = nominal_y();
  axis.gear.backlash_deg = 0.35;
  axis.elasticity.damping_ratio = 0.5;
  const double gap_m = 0.5 * 0.35 * std::numbers::pi / 180 * axis.output_radius_m;
  Bench bench(axis, 2.0);
  int open = 0;
  for (int k = 0; k < 100000; ++k) {
    bench.ask_current(axis, 0.5 * std::sin(8.0 * k * 1e-4));
    bench.tick();
    const auto s = bench.plant.state();
    const double stretch_m = radius_of(axis) * s.motor_angle_rad - s.carriage_m;
    const double force_N = bench.plant.forces().transmission_force_N;
    if (std::abs(stretch_m) < gap_m) {
      ++open;
      ASSERT_EQ(force_N, 0.0);
    } else {
      ASSERT_GE(force_N * stretch_m, -1e-12);
    }
  }
  EXPECT_GT(open, 100);
}

}  // namespace
}  // namespace towbench::tests
