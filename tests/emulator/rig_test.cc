#include "emulator/rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;

protocol::PwmDuty duty(Axis axis, int ticks, std::uint32_t sequence) {
  return {.axis = axis,
          .enable = true,
          .channel_a_ticks = static_cast<std::uint16_t>(ticks > 0 ? ticks : 0),
          .channel_b_ticks = static_cast<std::uint16_t>(ticks < 0 ? -ticks : 0),
          .period_ticks = 1000,
          .sequence = sequence};
}

// Enabled, with constant duty on both axes.
Rig driven_rig(const RigParameters& parameters, int y_ticks, int x_ticks) {
  Rig rig(parameters, 1);
  for (const Axis which : core::kPlanarAxes) {
    rig.axis(which)->enable_line = true;
    EXPECT_EQ(
        rig.axis(which)->command.accept(duty(which, which == Axis::kY ? y_ticks : x_ticks, 0)),
        core::ErrorCode::kNone);
  }
  return rig;
}

void run(Rig& rig, double duration_s) {
  const auto ticks = static_cast<int>(duration_s / core::kPlantTick_s + 0.5);
  for (int i = 0; i < ticks; ++i) {
    rig.step();
  }
}

// The plant's own motion, stick-slip and reversals inside a tick included. Where the angle is
// within rounding of a whole count either side is right.
TEST(Rig, TheCountIsTheFloorOfTheMotorsAngleAtTheEndOfEveryTick) {
  Rig rig = driven_rig(rig_starting_at(1.0, 0.3), 0, 0);
  std::uint32_t sequence = 1;
  int reversals = 0;
  core::PerAxis<double> last_speed{};
  for (int tick = 0; tick < 30'000; ++tick) {
    if (tick % 350 == 0) {
      const int sign = tick % 700 == 0 ? 1 : -1;
      for (const Axis which : core::kPlanarAxes) {
        ASSERT_EQ(rig.axis(which)->command.accept(duty(which, sign * 120, sequence)),
                  core::ErrorCode::kNone);
      }
      ++sequence;
    }
    rig.step();
    for (const Axis which : core::kPlanarAxes) {
      const AxisTruth axis = rig.truth().axes[which];
      const double counts = axis.motor_angle_rad * 4000.0 / (2.0 * std::numbers::pi);
      if (std::fabs(counts - std::round(counts)) > 1e-6) {
        ASSERT_EQ(axis.count, static_cast<std::int64_t>(std::floor(counts))) << tick;
      }
      reversals += axis.motor_speed_rad_per_s * last_speed[which] < 0.0 ? 1 : 0;
      last_speed[which] = axis.motor_speed_rad_per_s;
    }
  }
  EXPECT_GT(reversals, 20);
}

// Behind the elastic transmission, which the carriage leaves by many counts.
TEST(Rig, AnEncoderOnTheLoadCountsTheCarriage) {
  auto parameters = rig_starting_at(1.0, 0.3);
  parameters.axes[Axis::kY].encoder.side = EncoderSide::kLoad;
  Rig rig = driven_rig(parameters, 0, 0);
  const double m_per_count = metres_per_count(parameters.axes[Axis::kY]);
  double farthest_counts = 0;
  std::uint32_t sequence = 1;
  for (int tick = 0; tick < 10'000; ++tick) {
    if (tick % 350 == 0) {
      const int sign = tick % 700 == 0 ? 1 : -1;
      ASSERT_EQ(rig.axis(Axis::kY)->command.accept(duty(Axis::kY, sign * 120, sequence++)),
                core::ErrorCode::kNone);
    }
    rig.step();
    const AxisTruth axis = rig.truth().axes[Axis::kY];
    const double counts = axis.carriage_m / m_per_count;
    if (std::fabs(counts - std::round(counts)) > 1e-6) {
      ASSERT_EQ(axis.count, static_cast<std::int64_t>(std::floor(counts))) << tick;
    }
    const double motor_counts = axis.motor_angle_rad * 4000.0 / (2.0 * std::numbers::pi);
    farthest_counts = std::max(farthest_counts, std::fabs(motor_counts - counts));
  }
  EXPECT_GT(farthest_counts, 20.0);
}

TEST(Rig, AxesAreIndependentWithoutACrossTerm) {
  Rig both = driven_rig(rig_starting_at(1.0, 0.1), 200, 150);
  Rig y_only = driven_rig(rig_starting_at(1.0, 0.1), 200, 0);
  run(both, 0.2);
  run(y_only, 0.2);
  EXPECT_GT(both.truth().axes[Axis::kX].carriage_m, 0.11);
  // Well below the speed at which the shared supply limits, so not one bit of Y differs.
  EXPECT_EQ(both.truth().axes[Axis::kY].motor_angle_rad,
            y_only.truth().axes[Axis::kY].motor_angle_rad);
}

TEST(Rig, TheCrossTermPushesByItsShareOfTheOtherAxissTransmissionForce) {
  // Y held below break-away: at rest its transmission carries exactly the push, and X's
  // transmission force is X's own friction once X runs at constant speed.
  RigParameters parameters = rig_starting_at(1.0, 0.1);
  parameters.axes[Axis::kY].cross_axis_force_ratio = 0.25;
  Rig with = driven_rig(parameters, 0, 150);
  run(with, 0.02);
  const double x_force = with.truth().axes[Axis::kX].transmission_force_N;
  with.step();
  const double y_external = with.axis(Axis::kY)->plant().forces().external_force_N;
  ASSERT_GT(std::fabs(x_force), 0.05);
  EXPECT_DOUBLE_EQ(y_external, 0.25 * x_force);
}

TEST(Rig, OneAxisAtFullDutySagsTheSupplyOfTheOther) {
  RigParameters parameters = rig_starting_at(1.0, 0.1);
  parameters.supply.source_resistance_ohm = 0.3;
  parameters.supply.cut_out_V = 5.0;
  parameters.supply.over_current_A = 50.0;
  Rig rig = driven_rig(parameters, 1000, 0);
  run(rig, 0.04);  // at the current limit and fast, not yet at the voltage limit
  const AxisTruth y = rig.truth().axes[Axis::kY];
  const double winding_W = (0.611 * y.current_A + 26.7e-3 * y.motor_speed_rad_per_s) * y.current_A;
  // P = 0.95 V I and V = 12 - 0.3 I: the larger root.
  const double i = (12.0 - std::sqrt(144.0 - 4.0 * 0.3 * winding_W / 0.95)) / (2.0 * 0.3);
  EXPECT_NEAR(rig.supply().voltage_V(), 12.0 - 0.3 * i, 0.02);
  EXPECT_LT(rig.supply().voltage_V(), 11.5);
}

TEST(Rig, ASagLimitsTheSpeedOfBothAxesToTheVoltageLeft) {
  // Far from the ends for long enough: top speed is (0.9 V - R i) / K_T.
  RigParameters strong = rig_starting_at(0.2, 0.1);
  strong.axes[Axis::kY].plant.hard_ends.fitted = false;
  RigParameters weak = strong;
  weak.supply.voltage_V = 11.5;
  Rig at_12 = driven_rig(strong, 1000, 0);
  Rig at_11_5 = driven_rig(weak, 1000, 0);
  run(at_12, 3.0);
  run(at_11_5, 3.0);
  for (const Rig* rig : {&at_12, &at_11_5}) {
    const AxisTruth y = rig->truth().axes[Axis::kY];
    const double limit_V = 0.9 * rig->supply().voltage_V();
    EXPECT_NEAR(y.motor_speed_rad_per_s, (limit_V - 0.611 * y.current_A) / 26.7e-3,
                0.002 * y.motor_speed_rad_per_s);
  }
  EXPECT_LT(at_11_5.truth().axes[Axis::kY].motor_speed_rad_per_s,
            0.97 * at_12.truth().axes[Axis::kY].motor_speed_rad_per_s);
}

TEST(Rig, APushGivesItsImpulseHoweverItFallsIntoATick) {
  // A free axis: speed gained is the impulse over the mass, up to when it is looked at.
  const auto gained = [](core::Nanoseconds push_ns) {
    RigParameters parameters = rig_starting_at(1.0, 0.1);
    AxisParameters& y = parameters.axes[Axis::kY].plant;
    y.coulomb_friction_Nm = 0.0;
    y.friction.breakaway_Nm = 0.0;
    y.viscous_friction_Nm_s_per_rad = 0.0;
    y.elasticity.rigid = true;
    Rig rig(parameters, 1);
    for (int tick = 0; tick < 100; ++tick) {
      if (push_ns >= rig.now_ns() && push_ns < rig.now_ns() + core::kPlantTick_ns) {
        rig.push_carriage(Axis::kY, 10.0, push_ns);
      }
      rig.step();
    }
    return rig.truth().axes[Axis::kY].carriage_speed_m_per_s;
  };
  const double motor_rad_per_m = 34.97727272727273 / 0.050;
  const double mass_kg = 1.714e-5 * motor_rad_per_m * motor_rad_per_m;
  for (const core::Nanoseconds push_ns : {0, 2'000'000, 2'030'000, 2'099'999}) {
    const double expected = 10.0 * static_cast<double>(10'000'000 - push_ns) * 1e-9 / mass_kg;
    EXPECT_NEAR(gained(push_ns), expected, 1e-6 * expected) << push_ns;
  }
}

TEST(Rig, StandsStillForAMinuteUnderALoadBelowBreakAway) {
  Rig rig(rig_starting_at(1.0, 0.1), 1);
  rig.push_carriage(Axis::kY, 1.0, 0);
  run(rig, 2.0);
  const TruthRow settled = rig.truth();
  run(rig, 60.0);
  EXPECT_EQ(rig.truth().axes[Axis::kY].edges_total, settled.axes[Axis::kY].edges_total);
  EXPECT_EQ(rig.truth().axes[Axis::kX].edges_total, 0);
}

}  // namespace
}  // namespace towbench::emulator
