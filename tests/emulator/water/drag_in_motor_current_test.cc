// Drag as the drive feels it: the two-step motor current method of chapter 8, (8.5), on the nominal
// machine with its elastic transmission, friction map and quantised duty.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "emulator/rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;

struct Tow {
  double current_A = 0;
  double speed_squared = 0;
  double acceleration_m_per_s2 = 0;
};

// Means over one metre in mid tank at a speed held by a PI law on the motor's speed.
Tow tow(const WaterParameters& water, double speed_m_per_s) {
  RigParameters parameters;
  parameters.water = water;
  parameters.axes[Axis::kY].start_m = 0.5;
  const AxisParameters& p = parameters.axes[Axis::kY].plant;
  const double metres_per_motor_rad = p.output_radius_m / p.gear_ratio;
  Rig rig(parameters, 1);
  RigAxis& y = *rig.axis(Axis::kY);
  y.enable_line = true;
  double integral = 0.0;
  Tow mean;
  double ticks = 0.0;
  double first_speed = 0.0;
  double last_speed = 0.0;
  for (std::uint32_t tick = 0; y.plant().state().carriage_m < 2.6; ++tick) {
    const AxisState state = y.plant().state();
    if (tick % 10 == 0) {
      const double error = speed_m_per_s - metres_per_motor_rad * state.motor_speed_rad_per_s;
      integral += 1e-3 * error;
      const double wanted = std::clamp(1500.0 * error + 3000.0 * integral, -999.0, 999.0);
      const auto size = static_cast<std::uint16_t>(std::lround(std::fabs(wanted)));
      EXPECT_EQ(y.command.accept({.axis = Axis::kY,
                                  .enable = true,
                                  .channel_a_ticks = wanted > 0 ? size : std::uint16_t{0},
                                  .channel_b_ticks = wanted > 0 ? std::uint16_t{0} : size,
                                  .period_ticks = 1000,
                                  .sequence = tick / 10}),
                core::ErrorCode::kNone);
    }
    rig.step();
    if (state.carriage_m > 1.6) {
      first_speed = ticks == 0.0 ? state.carriage_speed_m_per_s : first_speed;
      last_speed = state.carriage_speed_m_per_s;
      mean.current_A += state.current_A;
      mean.speed_squared += state.carriage_speed_m_per_s * state.carriage_speed_m_per_s;
      ticks += 1.0;
    }
  }
  mean.current_A /= ticks;
  mean.speed_squared /= ticks;
  mean.acceleration_m_per_s2 = (last_speed - first_speed) / (ticks * core::kPlantTick_s);
  return mean;
}

TEST(DragInMotorCurrent, TheCurrentsOfTwoTowsDifferByTheDragBetweenThem) {
  WaterParameters water;
  water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 8.78, .added_mass_kg = 0.5};
  for (const double speed : {0.15, 0.3, 0.45}) {
    const Tow dry = tow({}, speed);
    const Tow wet = tow(water, speed);
    ASSERT_NEAR(std::sqrt(wet.speed_squared), speed, 0.01 * speed);
    ASSERT_NEAR(wet.acceleration_m_per_s2, 0.0, 2e-3);
    // (8.5), n/R K_T (i_1 - i_2); friction, the same in both, drops out.
    const double force_N = 34.97727272727273 / 0.050 * 26.7e-3 * (wet.current_A - dry.current_A);
    EXPECT_NEAR(force_N / wet.speed_squared, 8.78, 0.01 * 8.78) << speed;
  }
}

}  // namespace
}  // namespace towbench::emulator
