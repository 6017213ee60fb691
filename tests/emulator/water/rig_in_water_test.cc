// The rig in water, where its motion has a closed form.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/emulator/water/free_rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr double kD = 8.78;  // Table 8.4, exponent corrected
constexpr double kB = 2.0;

RigParameters with_object(const WaterBodyParameters& object) {
  RigParameters rig = free_rig();
  rig.water.object = object;
  return rig;
}

// Each case: what is in the water, and speed and way after t of coasting from v_0.
struct Coast {
  const char* name;
  WaterBodyParameters object;
  double (*speed)(double v0, double t);
  double (*way)(double v0, double t);
};

// M v' = -D v^2: v = v0 / (1 + t D v0 / M).
constexpr Coast kQuadratic{
    "quadratic",
    {.in_water = true, .quadratic_drag_N_s2_per_m2 = kD},
    [](double v0, double t) { return v0 / (1.0 + kD * v0 * t / kFreeMass_kg); },
    [](double v0, double t) { return kFreeMass_kg / kD * std::log1p(kD * v0 * t / kFreeMass_kg); }};

// M v' = -B v.
constexpr Coast kLinear{"linear",
                        {.in_water = true, .linear_drag_N_s_per_m = kB},
                        [](double v0, double t) { return v0 * std::exp(-kB * t / kFreeMass_kg); },
                        [](double v0, double t) {
                          return -kFreeMass_kg / kB * v0 * std::expm1(-kB * t / kFreeMass_kg);
                        }};

// M v' = -B v - D v^2: with e = exp(-B t / M), v = B v0 e / (B + D v0 (1 - e)).
constexpr Coast kBoth{
    "both",
    {.in_water = true, .quadratic_drag_N_s2_per_m2 = kD, .linear_drag_N_s_per_m = kB},
    [](double v0, double t) {
      const double e = std::exp(-kB * t / kFreeMass_kg);
      return kB * v0 * e / (kB + kD * v0 * (1.0 - e));
    },
    [](double v0, double t) {
      return kFreeMass_kg / kD * std::log1p(-kD * v0 / kB * std::expm1(-kB * t / kFreeMass_kg));
    }};

class CoastingInWater : public testing::TestWithParam<Coast> {};

TEST_P(CoastingInWater, FollowsTheClosedForm) {
  const Coast& c = GetParam();
  Rig rig(with_object(c.object), 1);
  set_in_motion(rig, 30.0, 0.0, 1200);
  rig.step();  // the first tick without push, after which the last change of speed is the water's
  const double v0 = speed_of(rig, Axis::kY);
  const double y0 = place_of(rig, Axis::kY);
  ASSERT_GT(v0, 0.4);
  for (int tick = 1; tick <= 50'000; ++tick) {
    rig.step();
    const double t = tick * core::kPlantTick_s;
    ASSERT_NEAR(speed_of(rig, Axis::kY), c.speed(v0, t), 1e-8) << t;
    ASSERT_NEAR(place_of(rig, Axis::kY) - y0, c.way(v0, t), 1e-8) << t;
  }
  EXPECT_EQ(speed_of(rig, Axis::kX), 0.0);
}

// |v| follows the same law in any direction, and the direction stays: drag is a vector. The law per
// component, D v_x |v_x|, would curve the path.
TEST_P(CoastingInWater, KeepsItsDirectionWhenItRunsAcrossTheTank) {
  const Coast& c = GetParam();
  Rig rig(with_object(c.object), 1);
  set_in_motion(rig, 24.0, 18.0, 1200);
  rig.step();
  const double v0 = std::hypot(speed_of(rig, Axis::kY), speed_of(rig, Axis::kX));
  for (int tick = 1; tick <= 20'000; ++tick) {
    rig.step();
    const double y = speed_of(rig, Axis::kY);
    const double x = speed_of(rig, Axis::kX);
    ASSERT_NEAR(std::hypot(y, x), c.speed(v0, tick * core::kPlantTick_s), 1e-8);
    ASSERT_NEAR(x / y, 0.75, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, CoastingInWater, testing::Values(kQuadratic, kLinear, kBoth),
                         [](const auto& tested) { return std::string(tested.param.name); });

// M v' = F - D v^2 from rest: v = v_t tanh(t F / (M v_t)), v_t = sqrt(F / D).
TEST(RigInWater, ReachesItsTerminalSpeedByTheHyperbolicTangent) {
  constexpr double kPush_N = 2.0;
  Rig rig(with_object(kQuadratic.object), 1);
  rig.push_carriage(Axis::kY, kPush_N, 0);
  const double terminal = std::sqrt(kPush_N / kD);
  for (int tick = 1; tick <= 100'000; ++tick) {
    rig.step();
    const double t = tick * core::kPlantTick_s;
    ASSERT_NEAR(speed_of(rig, Axis::kY),
                terminal * std::tanh(t * kPush_N / (kFreeMass_kg * terminal)), 1e-7)
        << t;
  }
  EXPECT_NEAR(speed_of(rig, Axis::kY), terminal, 1e-4 * terminal);
}

// What drag takes, kinetic energy loses: an elongated body on a curved path, both axes.
TEST(RigInWater, TheWorkOfTheWaterIsTheEnergyTheMotionLoses) {
  Rig rig(with_object({.in_water = true,
                       .quadratic_drag_N_s2_per_m2 = kD,
                       .linear_drag_N_s_per_m = 0.5,
                       .across_drag_ratio = 4.0,
                       .yaw_deg = 30.0,
                       .added_mass_kg = 1.5}),
          1);
  set_in_motion(rig, 30.0, -12.0, 1000);
  const auto kinetic_J = [&] {
    return 0.5 * (kFreeMass_kg + 1.5) *
           (std::pow(speed_of(rig, Axis::kY), 2) + std::pow(speed_of(rig, Axis::kX), 2));
  };
  const double start_J = kinetic_J();
  double work_J = 0.0;
  const double start_ratio = speed_of(rig, Axis::kX) / speed_of(rig, Axis::kY);
  for (int tick = 0; tick < 20'000; ++tick) {
    const double y = place_of(rig, Axis::kY);
    const double x = place_of(rig, Axis::kX);
    rig.step();
    work_J += rig.water_force_N()[Axis::kY] * (place_of(rig, Axis::kY) - y) +
              rig.water_force_N()[Axis::kX] * (place_of(rig, Axis::kX) - x);
    ASSERT_NEAR(kinetic_J() - start_J, work_J, 1e-9 * start_J);
  }
  EXPECT_LT(kinetic_J(), 0.3 * start_J);
  EXPECT_GT(std::fabs(speed_of(rig, Axis::kX) / speed_of(rig, Axis::kY) - start_ratio), 0.1);
}

// (3.9): the same push, a larger mass; exact, at any size.
TEST(RigInWater, AddedMassSlowsThePushByTheMassRatio) {
  for (const double added_kg : {0.0, 0.5, 6.0, 60.0}) {
    Rig rig(with_object({.in_water = true, .added_mass_kg = added_kg}), 1);
    rig.push_carriage(Axis::kY, 5.0, 0);
    rig.push_carriage(Axis::kX, -2.0, 0);
    for (int i = 0; i < 10'000; ++i) {
      rig.step();
    }
    EXPECT_NEAR(speed_of(rig, Axis::kY), 5.0 / (kFreeMass_kg + added_kg), 1e-11) << added_kg;
    EXPECT_NEAR(speed_of(rig, Axis::kX), -2.0 / (kFreeMass_kg + added_kg), 1e-11) << added_kg;
  }
}

// The free-free mode of the elastic axis: the same spring, the carriage heavier by the water.
TEST(RigInWater, AddedMassLowersTheTransmissionModeAsTheTwoMassFormulaSays) {
  RigParameters parameters = free_rig();
  AxisParameters& p = parameters.axes[Axis::kY].plant;
  p.elasticity = {.rigid = false, .resonance_Hz = 9.0, .damping_ratio = 0.0};
  constexpr double kAdded_kg = 3.0;
  parameters.water.object = {.in_water = true, .added_mass_kg = kAdded_kg};
  Rig rig(parameters, 1);
  rig.push_carriage(Axis::kY, 10.0, 0);
  // Stretch against time: count the upward zero crossings of its oscillation about its mean.
  const double r = p.output_radius_m / p.gear_ratio;
  const double motor_kg = 0.2 * kFreeMass_kg;
  const double carriage_kg = 0.8 * kFreeMass_kg;
  const double expected_Hz = 9.0 * std::sqrt((1.0 / motor_kg + 1.0 / (carriage_kg + kAdded_kg)) /
                                             (1.0 / motor_kg + 1.0 / carriage_kg));
  const double w0 = 2.0 * std::acos(-1.0) * 9.0;
  const double stiffness = w0 * w0 / (1.0 / motor_kg + 1.0 / carriage_kg);
  // Accelerating together, the transmission pulls the motor's mass along.
  const double mean_stretch = -10.0 * motor_kg / (motor_kg + carriage_kg + kAdded_kg) / stiffness;
  double last = 0.0;
  double first_s = 0.0;
  double last_s = 0.0;
  int crossings = 0;
  for (int tick = 1; tick <= 100'000; ++tick) {
    rig.step();
    const AxisTruth y = rig.truth().axes[Axis::kY];
    const double swing = r * y.motor_angle_rad - y.carriage_m - mean_stretch;
    if (tick > 1 && last < 0.0 && swing >= 0.0) {
      last_s = (tick - swing / (swing - last)) * core::kPlantTick_s;
      first_s = crossings == 0 ? last_s : first_s;
      ++crossings;
    }
    last = swing;
  }
  ASSERT_GT(crossings, 50);
  EXPECT_NEAR((crossings - 1) / (last_s - first_s), expected_Hz, 1e-5 * expected_Hz);
}

// The mean thrust against quadratic drag: D v^2 = F_0 once the oscillation is averaged out.
TEST(RigInWater, AFinDrivesAFreeCarriageUntilDragBalancesItsThrust) {
  RigParameters parameters = with_object(kQuadratic.object);
  parameters.water.object.yaw_deg = 90.0;
  parameters.water.fin = {.fitted = true, .mean_thrust_N = 0.5};
  Rig rig(parameters, 1);
  for (int i = 0; i < 300'000; ++i) {
    rig.step();
  }
  EXPECT_NEAR(speed_of(rig, Axis::kX), -std::sqrt(0.5 / kD), 1e-6);
  EXPECT_NEAR(speed_of(rig, Axis::kY), 0.0, 1e-12);
}

TEST(RigInWater, ShaftAndObjectAddUp) {
  RigParameters parameters = free_rig();
  parameters.water.shaft = {
      .in_water = true, .quadratic_drag_N_s2_per_m2 = 0.8, .added_mass_kg = 0.1};
  parameters.water.object = {
      .in_water = true, .quadratic_drag_N_s2_per_m2 = 8.0, .added_mass_kg = 0.4};
  RigParameters one = free_rig();
  one.water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 8.8, .added_mass_kg = 0.5};
  Rig both(parameters, 1);
  Rig together(one, 1);
  set_in_motion(both, 20.0, 10.0, 2000);
  set_in_motion(together, 20.0, 10.0, 2000);
  EXPECT_NEAR(speed_of(both, Axis::kY), speed_of(together, Axis::kY), 1e-13);
}

TEST(RigInWater, WhatHangsInTheAirChangesNoBit) {
  RigParameters dry;
  dry.water.shaft = {.quadratic_drag_N_s2_per_m2 = 1.0, .added_mass_kg = 0.2};
  dry.water.object = {.quadratic_drag_N_s2_per_m2 = 8.78, .added_mass_kg = 0.5};
  Rig nominal(RigParameters{}, 1);
  Rig hung(dry, 1);
  for (Rig* rig : {&nominal, &hung}) {
    set_in_motion(*rig, 25.0, 8.0, 3000);
  }
  EXPECT_GT(speed_of(nominal, Axis::kY), 0.1);
  EXPECT_EQ(speed_of(nominal, Axis::kY), speed_of(hung, Axis::kY));
  EXPECT_EQ(speed_of(nominal, Axis::kX), speed_of(hung, Axis::kX));
}

}  // namespace
}  // namespace towbench::emulator
