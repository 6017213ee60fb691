// An axis that is put elsewhere and faster between two steps, against closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

// M v' = -C: it goes v^2 M / 2 C further and stands for good.
TEST(Displace, AKickedAxisSlidesAsFarAsItsFrictionLetsIt) {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  axis.hard_ends.fitted = false;
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.friction.breakaway_Nm = axis.coulomb_friction_Nm;
  const double r = radius_of(axis);
  for (const double kick_m_per_s : {0.3, -0.3}) {
    Bench bench(axis, 1.0);
    bench.input.amplifier_enabled = false;
    bench.run(0.01);
    bench.plant.displace(0.2, kick_m_per_s);
    EXPECT_DOUBLE_EQ(bench.plant.state().carriage_m, 1.2);
    EXPECT_DOUBLE_EQ(bench.plant.state().carriage_speed_m_per_s, kick_m_per_s);
    bench.run(5);
    const double way_m =
        kick_m_per_s * kick_m_per_s * axis.inertia_kg_m2 / (2 * axis.coulomb_friction_Nm * r);
    EXPECT_NEAR(bench.plant.state().carriage_m, 1.2 + std::copysign(way_m, kick_m_per_s),
                1e-6 * way_m);
    EXPECT_EQ(bench.plant.state().carriage_speed_m_per_s, 0.0);
  }
}

// Nothing in the axis depends on its place: elsewhere, the same way follows, spring, current and
// the direction of each body's friction included.
TEST(Displace, ElsewhereTheSameMotionGoesOn) {
  AxisParameters axis;
  axis.hard_ends.fitted = false;
  axis.friction.options.presliding.travel_rad = 0.05;
  Bench stays(axis, 1.0);
  stays.ask_current(axis, 1.0);
  stays.run(0.237);
  Bench moved = stays;
  moved.plant.displace(0.3, 0);
  for (Bench* bench : {&stays, &moved}) {
    bench->ask_current(axis, -0.4);
    bench->run(0.8);
  }
  EXPECT_NEAR(moved.plant.state().carriage_m - stays.plant.state().carriage_m, 0.3, 1e-9);
  EXPECT_NEAR(moved.plant.state().carriage_speed_m_per_s,
              stays.plant.state().carriage_speed_m_per_s, 1e-9);
  EXPECT_NEAR(moved.plant.state().current_A, stays.plant.state().current_A, 1e-9);
}

TEST(Displace, ABodyThatRestsGoesOnResting) {
  Bench bench(nominal_y(), 1.0);
  bench.run(0.1);
  bench.plant.displace(0.1, 0);
  bench.run(1);
  EXPECT_DOUBLE_EQ(bench.plant.state().carriage_m, 1.1);
  EXPECT_EQ(bench.plant.state().motor_speed_rad_per_s, 0.0);
}

}  // namespace
}  // namespace towbench::tests
