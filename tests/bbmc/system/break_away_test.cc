// Break-away found by the machine: the torque at which it moves, not a swing left over from before.
#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/trajectory/steps_program.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using core::Axis;
using core::ErrorCode;

bbmc::OpenLoopRequest break_away(Axis axis) {
  bbmc::OpenLoopRequest request;
  request.driven[axis] = true;
  request.program[axis] = bbmc::BreakAwayProgram::make({}).value();
  request.stop_speed_count_per_s = 1000;
  return request;
}

// What the drive gave when the axis broke away, in N m.
double breaking_torque_Nm(Machine& machine, Axis axis) {
  EXPECT_TRUE(machine.system().request_open_loop(break_away(axis)));
  EXPECT_TRUE(machine.run_until_rest(20.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  return machine.status(axis).break_away_duty_pct / 100.0 *
         bbmc::Configuration().axes[axis].drive.full_duty_torque_Nm();
}

TEST(BreakAway, AnAxisThatStillSwingsHasNotBrokenAway) {
  Machine::Options options;
  options.configuration = tuned(kLaws.front());
  options.configuration.hold_time_s = 0;
  Machine still(options);
  still.run_for(1.0);
  const double expected_Nm = breaking_torque_Nm(still, Axis::kY);
  // Motor and carriage together: between the motor's own share and worst break-away.
  EXPECT_GT(expected_Nm, 1.3e-3);
  EXPECT_LT(expected_Nm, 5.3e-3);

  Machine swinging(options);
  ASSERT_TRUE(swinging.system().request_motion(trapezoid(swinging, Axis::kY, 0.05, 0.2, 0.05)));
  ASSERT_TRUE(swinging.run_until_rest(10.0));
  const double found_Nm = breaking_torque_Nm(swinging, Axis::kY);
  EXPECT_GT(found_Nm, 1.3e-3);
  EXPECT_LT(found_Nm, 5.3e-3);
}

}  // namespace
}  // namespace towbench::tests
