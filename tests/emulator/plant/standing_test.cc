// An axis that stands still is not stepped (plain_tick.h): whatever may move it must wake it.
#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

constexpr double kStart_m = 2.0;

// Stood for half a second with the amplifier on and nothing commanded.
Bench stood() {
  Bench bench(nominal_y(), kStart_m);
  bench.run(0.5);
  return bench;
}

// The same input on an axis that never stood.
void expect_to_move_like_a_fresh_one(Bench& bench) {
  Bench fresh(nominal_y(), kStart_m);
  fresh.input = bench.input;
  bench.run(0.05);
  fresh.run(0.05);
  EXPECT_NE(fresh.plant.state().carriage_m, kStart_m);
  EXPECT_DOUBLE_EQ(bench.plant.state().motor_angle_rad, fresh.plant.state().motor_angle_rad);
  EXPECT_DOUBLE_EQ(bench.plant.state().carriage_m, fresh.plant.state().carriage_m);
}

TEST(StandingAxis, IsWokenByACommand) {
  Bench bench = stood();
  bench.input.command_V = 2.0;
  expect_to_move_like_a_fresh_one(bench);
}

TEST(StandingAxis, IsWokenByAPushAloneEvenWithItsAmplifierOff) {
  Bench bench(nominal_y(), kStart_m);
  bench.input.amplifier_enabled = false;
  bench.run(0.5);
  bench.input.carriage_force_N = 15.0;
  expect_to_move_like_a_fresh_one(bench);
}

TEST(StandingAxis, SleepsOnThroughASaggingSupply) {
  Bench bench = stood();
  const double angle_rad = bench.plant.state().motor_angle_rad;
  for (int i = 0; i < 100; ++i) {
    bench.input.supply_V -= 1e-6;
    bench.tick();
  }
  EXPECT_EQ(bench.plant.state().motor_angle_rad, angle_rad);
  bench.input.command_V = -2.0;
  bench.run(0.05);
  EXPECT_LT(bench.plant.state().motor_angle_rad, angle_rad);
}

}  // namespace
}  // namespace towbench::tests
