// A body at rest that yields elastically, and neither creeps nor lets go early.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

constexpr double kTravel_rad = 0.03;

AxisParameters yielding_axis() {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  axis.friction.options.presliding = {.travel_rad = kTravel_rad, .damping_ratio = 0.5};
  return axis;
}

double current_for_A(const AxisParameters& axis, double share_of_breakaway) {
  return share_of_breakaway * axis.friction.breakaway_Nm / axis.torque_constant_Nm_per_A;
}

TEST(Presliding, YieldsByTheShareOfItsTravelThatTheLoadIsOfBreakAwayAndComesBack) {
  const AxisParameters axis = yielding_axis();
  Bench bench(axis, 1.0);
  const double start = bench.plant.state().motor_angle_rad;
  for (const double share : {0.2, 0.5, -0.7, 0.0}) {
    bench.ask_current(axis, current_for_A(axis, share));
    bench.run(3.0);
    EXPECT_NEAR(bench.plant.state().motor_angle_rad - start, share * kTravel_rad, 1e-9);
    EXPECT_TRUE(bench.plant.forces().motor_sticks);
  }
}

TEST(Presliding, DoesNotDriftUnderASwingingLoadForAnHour) {
  const AxisParameters axis = yielding_axis();
  Bench bench(axis, 1.0);
  const double start = bench.plant.state().motor_angle_rad;
  // 0.2 .. 0.8 of break-away, once a second, never letting go. Creep would show as a shift.
  for (int second = 0; second < 3600; ++second) {
    for (const double share : {0.2, 0.8}) {
      bench.ask_current(axis, current_for_A(axis, share));
      bench.run(0.5);
    }
  }
  bench.ask_current(axis, 0.0);
  bench.run(3.0);
  EXPECT_NEAR(bench.plant.state().motor_angle_rad, start, 1e-9);
}

TEST(Presliding, BreaksAwayAtItsLevelAndAtItsTravelEitherWay) {
  const AxisParameters axis = yielding_axis();
  for (const double sign : {1.0, -1.0}) {
    Bench bench(axis, 1.0);
    const double start = bench.plant.state().motor_angle_rad;
    int k = 0;
    while (bench.plant.forces().motor_sticks) {
      bench.ask_current(axis, sign * 5e-7 * ++k);
      bench.tick();
    }
    const double expected_A = current_for_A(axis, sign);
    EXPECT_NEAR(bench.plant.state().current_A, expected_A, 1e-3 * std::abs(expected_A));
    EXPECT_NEAR(bench.plant.state().motor_angle_rad - start, sign * kTravel_rad,
                1e-2 * kTravel_rad);
  }
}

TEST(Presliding, AnElasticBodyThatStoppedSpringsBackByItsTravel) {
  AxisParameters axis = yielding_axis();
  axis.friction.options.presliding.damping_ratio = 1.2;  // and not past it
  Bench bench(axis, 1.0);
  bench.ask_current(axis, 0.4);
  bench.run(0.1);
  bench.input.amplifier_enabled = false;
  double furthest = 0;
  for (int k = 0; k < 50000; ++k) {
    bench.tick();
    furthest = std::max(furthest, bench.plant.state().motor_angle_rad);
  }
  EXPECT_NEAR(furthest - bench.plant.state().motor_angle_rad, kTravel_rad,
              1e-5 * kTravel_rad);  // seen at ticks
}

TEST(Presliding, FrictionHasNoJumpWhereABodyStopsOrBreaksAway) {
  AxisParameters axis = yielding_axis();
  axis.friction.options.presliding.damping_ratio = 0;
  axis.friction.breakaway_Nm = axis.coulomb_friction_Nm;  // no fall with speed
  Bench bench(axis, 1.0, 1e-5);
  double before = bench.plant.forces().motor_friction_Nm;
  bool stuck = true;
  int changes = 0;
  for (int k = 0; k < 200000; ++k) {
    bench.ask_current(axis, 0.25 * std::sin(20.0 * k * 1e-5));
    bench.tick();
    const auto f = bench.plant.forces();
    if (f.motor_sticks != stuck) {
      ++changes;
      EXPECT_NEAR(f.motor_friction_Nm, before, 0.02 * axis.friction.breakaway_Nm) << k;
    }
    stuck = f.motor_sticks;
    before = f.motor_friction_Nm;
  }
  EXPECT_GT(changes, 5);
}

}  // namespace
}  // namespace towbench::tests
