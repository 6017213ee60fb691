// What the system manager refuses, and that a refusal changes nothing.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "bbmc/system/trajectory/trapezoid.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using bbmc::Hold;
using bbmc::MotionRequest;
using core::Axis;
using core::ErrorCode;

MotionRequest hold_at(double y_m) {
  MotionRequest request;
  request.driven[Axis::kY] = true;
  request.trajectory[Axis::kY] = Hold(y_m, 0.1);
  return request;
}

TEST(Defect4ApproachSpeed, AReferenceBeyondASoftLimitIsRefused) {
  Machine machine;
  EXPECT_EQ(machine.system().request_motion(trapezoid(machine, Axis::kY, 2.9, 0.3)).error(),
            ErrorCode::kRequestBeyondSoftLimit);
  EXPECT_EQ(machine.system().request_motion(trapezoid(machine, Axis::kX, -0.29, 0.1)).error(),
            ErrorCode::kRequestBeyondSoftLimit);
}

TEST(Defect4ApproachSpeed, AReferenceAboveTheAxesOwnTopSpeedIsRefused) {
  Machine machine;
  EXPECT_EQ(machine.system().request_motion(trapezoid(machine, Axis::kY, 1.0, 0.60)).error(),
            ErrorCode::kRequestTooFast);
  EXPECT_EQ(machine.system().request_motion(trapezoid(machine, Axis::kX, 0.2, 0.39)).error(),
            ErrorCode::kRequestTooFast);
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 1.0, 0.55)));
}

TEST(Defect4ApproachSpeed, NearAnEndOnlyWhatCanBeStoppedIsAccepted) {
  Machine::Options options;
  // Y min: 20 mm between soft limit and hall, 2.2 mm from there to the hard end.
  options.start_m[Axis::kY] = 0.40;
  Machine machine(options);
  const double distance_m = -(0.40 - 0.0230);
  EXPECT_EQ(
      machine.system().request_motion(trapezoid(machine, Axis::kY, distance_m, 0.5, 0.05)).error(),
      ErrorCode::kRequestTooFast);
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, distance_m, 0.2, 0.3)));
}

TEST(Defect4ApproachSpeed, BeforeCalibrationOnlyWhatTheNearerEndCanStopIsAccepted) {
  Machine::Options options;
  options.calibrated = false;
  Machine machine(options);
  const double limit = machine.system().speed_allowed_m_per_s(Axis::kY, 0.0, 1);
  EXPECT_EQ(
      machine.system().request_motion(trapezoid(machine, Axis::kY, 0.2, limit * 1.01)).error(),
      ErrorCode::kRequestTooFast);
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.2, limit)));
  EXPECT_TRUE(machine.run_until_rest(20.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_EQ(machine.system().request_goto({}).error(), ErrorCode::kRequestNotCalibrated);
}

TEST(Defect4ApproachSpeed, OpenLoopThatGetsTooFastForItsPlaceIsStopped) {
  Machine::Options options;
  options.calibrated = false;
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_open_loop(pulses(Axis::kY, 15, 4, false)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultSoftLimit);
  double fastest = 0;
  for (const auto& row : machine.truth) {
    fastest = std::max(fastest, std::fabs(row.axes[Axis::kY].carriage_speed_m_per_s));
  }
  EXPECT_LT(fastest, 0.10);
}

TEST(MotionRequest, AReferenceMustStartWhereTheAxisStands) {
  Machine machine;
  const double here_m = machine.status(Axis::kY).position_m;
  EXPECT_EQ(machine.system().request_motion(hold_at(here_m + 0.002)).error(),
            ErrorCode::kRequestOutOfRange);
  EXPECT_TRUE(machine.system().request_motion(hold_at(here_m + 0.0001)));
}

TEST(MotionRequest, OneMotionAtATime) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.1, 0.1)));
  const auto second = trapezoid(machine, Axis::kX, 0.1, 0.1);
  EXPECT_EQ(machine.system().request_motion(second).error(), ErrorCode::kRequestWrongState);
  machine.run_for(0.3);
  EXPECT_EQ(machine.system().request_motion(second).error(), ErrorCode::kRequestWrongState);
}

TEST(Defect12RefusedArgument, ChangesNothing) {
  Machine machine;
  auto& system = machine.system();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto gains = system.configuration().axes[Axis::kY].gains;
  EXPECT_FALSE(system.set_gains(Axis::kY, {.proportional_Nm_per_rad = -1}));
  EXPECT_FALSE(system.set_gains(Axis::kY, {.integral_Nm_per_rad_s = kNan}));
  EXPECT_FALSE(system.set_gains(Axis::kY, {.derivative_Nm_s_per_rad = 1.0}));  // unstable
  EXPECT_EQ(system.configuration().axes[Axis::kY].gains, gains);

  EXPECT_FALSE(system.set_control_rate(0));
  EXPECT_FALSE(system.set_control_rate(kNan));
  EXPECT_FALSE(system.set_control_rate(700));  // 1.43 ms is no multiple of the exchange
  EXPECT_EQ(system.configuration().control_rate_Hz, 1000.0);

  bbmc::AxisConfiguration parts = system.configuration().axes[Axis::kY];
  parts.feed_forward.inertia_kg_m2 = kNan;
  EXPECT_FALSE(system.set_law(Axis::kY, parts));
  EXPECT_FALSE(system.configuration().axes[Axis::kY].feed_forward.enabled);

  const auto count = machine.status(Axis::kY).count;
  EXPECT_FALSE(system.calibrate_position(Axis::kY, std::int64_t{1} << 50));
  EXPECT_EQ(machine.status(Axis::kY).count, count);

  EXPECT_FALSE(system.request_motion(hold_at(kNan)));
  EXPECT_FALSE(system.request_motion({}));  // drives nothing
  EXPECT_FALSE(system.request_goto({.target_m = {{kNan, 0.3}}}));
  EXPECT_FALSE(system.request_goto({.target_m = {{9.0, 0.3}}}));
  EXPECT_FALSE(system.stop());
  EXPECT_FALSE(system.reset());
  machine.run_for(0.05);
  EXPECT_TRUE(system.at_rest());
  EXPECT_EQ(system.status().motions_ended, 0U);
  EXPECT_EQ(machine.status(Axis::kY).mode, bbmc::AxisMode::kIdle);
}

TEST(MotionRequest, PositionIsDeclaredAtRestOnly) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.1, 0.1)));
  machine.run_for(0.2);
  EXPECT_EQ(machine.system().calibrate_position(Axis::kY, 5).error(),
            ErrorCode::kRequestWrongState);
  ASSERT_TRUE(machine.run_until_rest(10));
  EXPECT_TRUE(machine.system().calibrate_position(Axis::kY, 500'000));
  EXPECT_EQ(machine.status(Axis::kY).count, 500'000);
}

TEST(MotionRequest, AnAxisThatDoesNotExistCannotBeDriven) {
  Machine::Options options;
  options.configuration.axes[Axis::kX].exists = false;
  Machine machine(options);
  EXPECT_EQ(machine.system().request_open_loop(pulses(Axis::kX, 5)).error(),
            ErrorCode::kRequestOutOfRange);
}

TEST(MotionRequest, AMachineWithOneAxisIsDrivenOnThatOneOnly) {
  Machine::Options options;
  options.configuration.axes[Axis::kX].exists = false;
  options.rig.axes[Axis::kX].exists = false;
  Machine machine(options);
  MotionRequest request = trapezoid(machine, Axis::kY, 0.1, 0.2);
  request.driven[Axis::kX] = false;
  ASSERT_TRUE(machine.system().request_motion(request));
  ASSERT_TRUE(machine.run_until_rest(5.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_NEAR(machine.status(Axis::kY).position_m, options.start_m[Axis::kY] + 0.1, 1e-3);
  EXPECT_EQ(std::count_if(machine.duties.begin(), machine.duties.end(),
                          [](const Machine::Duty& d) { return d.message.axis == Axis::kX; }),
            0);
}

TEST(Stop, BrakesToStandstillAndLatchesNothing) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.8, 0.4)));
  machine.run_for(0.8);
  ASSERT_TRUE(machine.system().stop());
  ASSERT_TRUE(machine.run_until_rest(2.0));
  EXPECT_TRUE(machine.system().status().stopped_by_user);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_EQ(machine.status(Axis::kY).mode, bbmc::AxisMode::kIdle);
  EXPECT_FALSE(machine.status(Axis::kY).amplifier_enabled);
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, -0.1, 0.1)));
}

}  // namespace
}  // namespace towbench::tests
