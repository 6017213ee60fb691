#include "bbmc/system/stopping_distance.h"

#include <gtest/gtest.h>

#include "bbmc/system/configuration.h"

namespace towbench::bbmc {
namespace {

constexpr double kLatency_s = 2.5e-3;

TEST(StoppingDistance, SpeedIsTheInverseOfDistance) {
  for (const AxisConfiguration& axis : {AxisConfiguration{}, x_axis_defaults()}) {
    const StoppingDistance stopping(axis, kLatency_s);
    for (const double speed : {0.001, 0.05, 0.2, 0.57}) {
      EXPECT_NEAR(stopping.speed_m_per_s(stopping.distance_m(speed)), speed, 1e-12);
    }
    EXPECT_EQ(stopping.speed_m_per_s(0.0), 0.0);
    EXPECT_EQ(stopping.speed_m_per_s(-0.01), 0.0);
  }
}

// docs/reference/constants.md: full reverse current stops Y from 0.5 m/s in 15 mm if rigid, 21-23
// mm with the chain.
TEST(StoppingDistance, RigidYStopsFromHalfAMeterPerSecondInFifteenMillimetres) {
  AxisConfiguration rigid;
  rigid.braking.held_motor_chain_Hz = 1e6;
  rigid.braking.gear_torque_limit_Nm = 100;
  EXPECT_NEAR(StoppingDistance(rigid, 0.0).distance_m(0.5), 0.015, 0.0005);
}

TEST(StoppingDistance, TheElasticBoundIsAboveWhatThePlantNeeds) {
  EXPECT_GT(StoppingDistance(AxisConfiguration{}, kLatency_s).distance_m(0.5), 0.023);
}

// docs/reference/constants.md: about 0.05-0.10 m/s at Y min, 0.11-0.14 m/s at X min can still be
// stopped.
TEST(Defect4ApproachSpeed, BeforeCalibrationTheNearerEndSetsTheLimit) {
  const Configuration configuration;
  const SpeedLimits y(configuration.axes[core::Axis::kY], kLatency_s);
  const SpeedLimits x(configuration.axes[core::Axis::kX], kLatency_s);
  EXPECT_GT(y.uncalibrated_m_per_s(), 0.04);
  EXPECT_LT(y.uncalibrated_m_per_s(), 0.10);
  EXPECT_GT(x.uncalibrated_m_per_s(), 0.08);
  EXPECT_LT(x.uncalibrated_m_per_s(), 0.14);
}

TEST(Defect4ApproachSpeed, ItFallsTowardsTheEndThatIsApproachedOnly) {
  const AxisConfiguration axis;
  const SpeedLimits limits(axis, kLatency_s);
  const double near_max_m = axis.position_m(axis.ends.hall_max_count - 2'000);
  EXPECT_LT(limits.calibrated_m_per_s(near_max_m, 1), 0.15);
  EXPECT_EQ(limits.calibrated_m_per_s(near_max_m, -1), axis.speed_limit_m_per_s);
  EXPECT_EQ(limits.calibrated_m_per_s(axis.position_m(axis.ends.hall_max_count + 1), 1), 0.0);
  double last = 0;
  for (std::int64_t count = axis.ends.hall_max_count; count > 1'000'000; count -= 1'000) {
    const double allowed = limits.calibrated_m_per_s(axis.position_m(count), 1);
    EXPECT_GE(allowed, last);
    last = allowed;
  }
}

}  // namespace
}  // namespace towbench::bbmc
