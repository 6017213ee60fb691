// An axis that turns what hangs in the water, against a body that is mounted at that yaw.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "emulator/water/water.h"
#include "tests/emulator/water/free_rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr WaterBodyParameters kLong{.in_water = true,
                                    .quadratic_drag_N_s2_per_m2 = 2.0,
                                    .linear_drag_N_s_per_m = 0.3,
                                    .across_drag_ratio = 6.0,
                                    .yaw_deg = 10.0};

WaterParameters long_body_with_fin(double yaw_deg) {
  WaterParameters water;
  water.object = kLong;
  water.object.yaw_deg = yaw_deg;
  water.fin = {.fitted = true, .mean_thrust_N = 1.0, .side_amplitude_N = 0.5};
  return water;
}

TEST(TurnedLoad, IsTheBodyAtThatYaw) {
  const PlaneVector velocity{{0.3, -0.1}};
  for (const double turned_deg : {-170.0, -30.0, 0.0, 45.0, 90.0, 300.0}) {
    const Water mounted(long_body_with_fin(10.0 + turned_deg));
    const Water turned(long_body_with_fin(10.0));
    for (const core::Nanoseconds time_ns : {0, 100'000'000, 370'000'000}) {
      const auto expected = mounted.force_N(time_ns, velocity);
      const auto force = turned.force_N(time_ns, velocity, PlaneTurn(turned_deg / 360.0));
      EXPECT_NEAR(force[Axis::kY], expected[Axis::kY], 1e-14) << turned_deg;
      EXPECT_NEAR(force[Axis::kX], expected[Axis::kX], 1e-14) << turned_deg;
    }
  }
}

RigParameters with_axis_c(double angle_rad, bool turns) {
  RigParameters rig = free_rig();
  rig.water.object = kLong;
  RigAxisParameters& c = rig.axes[Axis::kC];
  c = rig.axes[Axis::kX];
  c.plant.hard_ends.min_m = -10.0;
  c.plant.hard_ends.max_m = 10.0;
  c.start_m = angle_rad;
  c.load_turns = turns;
  return rig;
}

double drag_of(const RigParameters& parameters) {
  Rig rig(parameters, 1);
  set_in_motion(rig, 30.0, 0.0, 1000);
  rig.step();
  return rig.water_force_N()[Axis::kY] / std::pow(speed_of(rig, Axis::kY), 2);
}

TEST(TurnedLoad, TurnsWithAxisC) {
  RigParameters mounted = free_rig();
  mounted.water.object = kLong;
  mounted.water.object.yaw_deg = 80.0;
  const double angle_rad = 70.0 / 180.0 * std::numbers::pi;
  EXPECT_NEAR(drag_of(with_axis_c(angle_rad, true)), drag_of(mounted), 1e-9);
}

// An axis c that moves along something turns nothing.
TEST(TurnedLoad, StaysWithAnAxisThatDoesNotTurn) {
  RigParameters mounted = free_rig();
  mounted.water.object = kLong;
  EXPECT_EQ(drag_of(with_axis_c(1.0, false)), drag_of(mounted));
  EXPECT_NE(drag_of(with_axis_c(1.0, true)), drag_of(mounted));
}

}  // namespace
}  // namespace towbench::emulator
