// What the six-axis sensor shows of the water: the FSM of chapter 8.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/emulator/water/free_rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr double kLoad_kg = 0.4;

RigParameters instrumented(RigParameters rig) {
  rig.force_sensor = {.fitted = true,
                      .load_mass_kg = kLoad_kg,
                      .lever_m = 0.3,
                      .bandwidth_Hz = 1000.0,
                      .force_noise_rms_N = 0.0,
                      .torque_noise_rms_Nm = 0.0,
                      .force_bias_deviation_N = 0.0,
                      .torque_bias_deviation_Nm = 0.0};
  return rig;
}

// Steps until a sample is there.
protocol::ForceSample next_sample(Rig& rig) {
  do {
    rig.step();
  } while (!rig.force_sample());
  return *rig.force_sample();
}

TEST(ForceSensorInWater, ShowsTheDragOfASteadyTowAndItsMoment) {
  // Towed by the drive to its terminal speed: a push would act on the load and cancel the drag.
  RigParameters parameters = instrumented(free_rig());
  parameters.water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 8.78};
  Rig rig(parameters, 1);
  RigAxis& y = *rig.axis(Axis::kY);
  y.enable_line = true;
  ASSERT_EQ(y.command.accept(
                {.axis = Axis::kY, .enable = true, .channel_a_ticks = 30, .period_ticks = 1000}),
            core::ErrorCode::kNone);
  for (int i = 0; i < 400'000; ++i) {
    rig.step();
  }
  const double v = speed_of(rig, Axis::kY);
  ASSERT_GT(v, 0.3);
  const protocol::ForceSample sample = next_sample(rig);
  EXPECT_NEAR(sample.force_N[1], -8.78 * v * v, 1e-5);
  EXPECT_NEAR(sample.torque_Nm[0], 0.3 * -8.78 * v * v, 1e-5);
  EXPECT_NEAR(sample.force_N[0], 0.0, 1e-12);
}

TEST(ForceSensorInWater, FeelsTheInertiaOfLoadAndWaterTogether) {
  RigParameters parameters = instrumented(free_rig());
  parameters.water.object = {.in_water = true, .added_mass_kg = 0.7};
  Rig rig(parameters, 1);
  RigAxis& y = *rig.axis(Axis::kY);
  y.enable_line = true;
  ASSERT_EQ(y.command.accept(
                {.axis = Axis::kY, .enable = true, .channel_a_ticks = 100, .period_ticks = 1000}),
            core::ErrorCode::kNone);
  for (int i = 0; i < 500; ++i) {
    rig.step();
  }
  const double before = speed_of(rig, Axis::kY);
  const double before_s = core::seconds(rig.now_ns());
  const protocol::ForceSample sample = next_sample(rig);
  const double acceleration =
      (speed_of(rig, Axis::kY) - before) / (core::seconds(rig.now_ns()) - before_s);
  ASSERT_GT(acceleration, 0.5);
  EXPECT_NEAR(sample.force_N[1], -(kLoad_kg + 0.7) * acceleration, 1e-4);
}

// EXP-5: a fish held still by the carriage's friction pushes on the sensor with its fin.
TEST(ForceSensorInWater, ShowsAFinsMeanThrustAndFrequencyOnAHeldCarriage) {
  RigParameters parameters = instrumented(RigParameters{});
  parameters.water.object = {.in_water = true};
  parameters.water.fin = {
      .fitted = true, .mean_thrust_N = 0.3, .thrust_amplitude_N = 0.5, .thrust_frequency_Hz = 2.0};
  Rig rig(parameters, 1);
  double sum = 0.0;
  double last = 0.0;
  int crossings = 0;
  constexpr int kSamples = 10'000;  // 20 periods
  for (int i = 0; i < 2000; ++i) {
    last = static_cast<double>(next_sample(rig).force_N[1]);
  }
  for (int i = 0; i < kSamples; ++i) {
    const auto force = static_cast<double>(next_sample(rig).force_N[1]);
    sum += force;
    crossings += last < 0.3 && force >= 0.3 ? 1 : 0;
    last = force;
  }
  EXPECT_NEAR(sum / kSamples, 0.3, 0.003);
  EXPECT_EQ(crossings, 20);
}

}  // namespace
}  // namespace towbench::emulator
