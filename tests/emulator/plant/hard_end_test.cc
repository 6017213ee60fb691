// Mechanical stops: what is recorded of a contact, and that a stop only pushes.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

// Drives at a steady current from `start_m` until the first contact.
Bench up_to_contact(const AxisParameters& axis, double start_m, double current_A) {
  Bench bench(axis, start_m);
  bench.ask_current(axis, current_A);
  for (int k = 0; k < 200000 && !bench.plant.contact().occurred; ++k) {
    bench.tick();
  }
  return bench;
}

TEST(HardEnd, ReportsTheImpactSpeedAndTheKineticEnergyOfCarriageAndDrive) {
  AxisParameters axis = nominal_y();
  const double r = radius_of(axis);
  const Bench bench = up_to_contact(axis, 3.7, 0.3);
  const auto& contact = bench.plant.contact();
  ASSERT_TRUE(contact.occurred);
  EXPECT_TRUE(contact.at_max);
  const auto state = bench.plant.state();
  EXPECT_GT(contact.time_s, 0.0);
  EXPECT_LE(contact.time_s, 1e-4);
  EXPECT_GT(contact.speed_m_per_s, 0.05);
  EXPECT_NEAR(contact.speed_m_per_s, state.carriage_speed_m_per_s, 0.03);  // a tick of braking
  const double mass = (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / (r * r);
  const double w = state.motor_speed_rad_per_s;
  EXPECT_NEAR(contact.energy_J,
              0.5 * mass * contact.speed_m_per_s * contact.speed_m_per_s +
                  0.5 * axis.rotor_inertia_kg_m2 * w * w,
              0.01 * contact.energy_J);
}

TEST(HardEnd, AContactAtTheMinEndHasANegativeSpeed) {
  const Bench bench = up_to_contact(nominal_y(), 0.2, -0.3);
  ASSERT_TRUE(bench.plant.contact().occurred);
  EXPECT_FALSE(bench.plant.contact().at_max);
  EXPECT_LT(bench.plant.contact().speed_m_per_s, -0.05);
}

TEST(HardEnd, AContactIsReportedInTheTickItHappensAndNotAgainWhileItLasts) {
  AxisParameters axis = nominal_y();
  Bench bench = up_to_contact(axis, 3.7, 0.3);
  bench.tick();
  EXPECT_FALSE(bench.plant.contact().occurred);
}

TEST(HardEnd, PushesOnlyAndLetsTheCarriageComeToRestAgainstTheDrive) {
  AxisParameters axis = nominal_y();
  Bench bench = up_to_contact(axis, 3.7, 0.3);
  double hardest_N = 0;
  for (int k = 0; k < 50000; ++k) {
    bench.tick();
    const double force = bench.plant.forces().end_force_N;
    ASSERT_LE(force, 0.0);
    hardest_N = std::min(hardest_N, force);
  }
  EXPECT_LT(hardest_N, -50.0);
  const auto s = bench.plant.state();
  EXPECT_EQ(s.carriage_speed_m_per_s, 0.0);
  EXPECT_GT(s.carriage_m, axis.hard_ends.max_m - 1e-3);
  EXPECT_LT(s.carriage_m, axis.hard_ends.max_m + 1e-3);
}

TEST(HardEnd, ARigidCarriageReboundsWithTheRestitutionOfItsDamper) {
  // Mass m on K, C with friction and drive off: for a lightly damped stop that cannot pull, contact
  // ends when K d + C d' = 0; the closed form of that instant gives the ratio of speeds.
  AxisParameters axis = linear_axis();
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.elasticity.rigid = true;
  axis.hard_ends = {.fitted = true, .min_m = 0, .max_m = 1};
  const double r = radius_of(axis);
  Bench bench(axis, 0.9);
  bench.input = {.carriage_force_N = 5.0};
  for (int k = 0; k < 100000 && !bench.plant.contact().occurred; ++k) {
    bench.input.carriage_force_N = bench.plant.state().carriage_m < 0.95 ? 5.0 : 0.0;
    bench.tick();
  }
  const double v0 = bench.plant.contact().speed_m_per_s;
  bench.run(0.1);
  const double v1 = bench.plant.state().carriage_speed_m_per_s;

  const double m = axis.inertia_kg_m2 / (r * r);
  const double wn = std::sqrt(axis.hard_ends.stiffness_N_per_m / m);
  const double zeta = axis.hard_ends.damping_N_s_per_m / (2 * m * wn);
  const double wd = wn * std::sqrt(1 - zeta * zeta);
  // d = v0/wd e^(-zeta wn t) sin(wd t); K d + C d' = 0 at tan(wd t) = -2 zeta sqrt(1-z^2)/(1-2z^2)
  const double phase =
      M_PI + std::atan2(-2 * zeta * std::sqrt(1 - zeta * zeta), 1 - 2 * zeta * zeta);
  const double decay = std::exp(-zeta * phase / std::sqrt(1 - zeta * zeta));
  const double restitution =
      -decay * (std::cos(phase) - zeta / std::sqrt(1 - zeta * zeta) * std::sin(phase));
  EXPECT_NEAR(-v1 / v0, restitution, 1e-6);
  EXPECT_GT(wd, 0);
}

}  // namespace
}  // namespace towbench::tests
