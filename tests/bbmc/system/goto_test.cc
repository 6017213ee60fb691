#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/approach_profile.h"
#include "core/random.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using bbmc::AxisMode;
using core::Axis;
using core::ErrorCode;

TEST(ApproachProfile, EndsOnTheTargetToTheBitWithinItsLimits) {
  for (const double target : {0.5, -0.3, 0.0001, 1e-8}) {
    for (const double step_s : {1e-3, 0.1}) {
      bbmc::ApproachProfile profile;
      profile.begin(0.0, target, 0.2, 0.5);
      double last_speed = 0;
      double last_position = 0;
      int steps = 0;
      while (!profile.arrived() && ++steps < 20'000) {
        const bbmc::Reference r = profile.step(step_s);
        EXPECT_LE(std::fabs(r.velocity_m_per_s), 0.2 + 1e-12);
        EXPECT_LE(std::fabs(r.velocity_m_per_s) - last_speed, 0.5 * step_s + 1e-12);
        EXPECT_LE(std::fabs(r.position_m), std::fabs(target) + 1e-15);
        EXPECT_GE((r.position_m - last_position) * target, 0.0);
        last_speed = std::fabs(r.velocity_m_per_s);
        last_position = r.position_m;
      }
      EXPECT_EQ(profile.step(step_s).position_m, target);
      EXPECT_LT(steps, 20'000);
    }
  }
}

TEST(Defect9Goto, DoneMeansThatBothAxesStandOnTheirTargets) {
  for (const bool fast : {false, true}) {
    Machine machine;
    // X is near, Y is far: X is there long before.
    const core::PerPlanarAxis<double> target{{1.35, 0.31}};
    ASSERT_TRUE(machine.system().request_goto({.target_m = target, .fast = fast}));
    ASSERT_TRUE(machine.run_until_rest(30.0));
    EXPECT_EQ(machine.system().status().last_motion_result, ErrorCode::kNone);
    for (Axis axis : core::kPlanarAxes) {
      const double counts_per_m = bbmc::Configuration().axes[axis].counts_per_m();
      EXPECT_LE(std::fabs(machine.status(axis).position_m - target[axis]) * counts_per_m, 1.5);
    }
  }
}

// Dry friction makes the last counts the hard ones: an axis that stands one off, another that waits
// on its target. Judged by where the motors truly are.
TEST(Goto, EndsWithinOneCountOnEachAxisWhereverItGoes) {
  Machine::Options options;
  options.configuration = tuned(kLaws.front());
  options.configuration.go_to.done_within_counts = 1;  // bbmc-tuned.toml
  Machine machine(options);
  core::Random random(7);
  for (int i = 0; i < 40; ++i) {
    const core::PerPlanarAxis<double> target{
        {0.1 + 3.4 * random.uniform(), 0.09 + 0.5 * random.uniform()}};
    machine.truth.clear();
    machine.rows.clear();
    ASSERT_TRUE(machine.system().request_goto({.target_m = target, .fast = true}));
    ASSERT_TRUE(machine.run_until_rest(60.0));
    ASSERT_EQ(machine.system().status().last_motion_result, ErrorCode::kNone)
        << target[Axis::kY] << ' ' << target[Axis::kX];
    for (Axis axis : core::kPlanarAxes) {
      const double target_count = target[axis] * bbmc::Configuration().axes[axis].counts_per_m();
      // The middle of the count on which the motor stands.
      const auto count = static_cast<double>(machine.truth.back().axes[axis].count) + 0.5;
      EXPECT_LE(std::fabs(count - target_count), 1.6);
    }
  }
}

TEST(Defect9Goto, ModeChangesAreBumpless) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_goto({.target_m = {{1.3, 0.35}}}));
  ASSERT_TRUE(machine.run_until_rest(30.0));
  bool changed = false;
  for (std::size_t i = 1; i < machine.rows.size(); ++i) {
    const auto& before = machine.rows[i - 1].axes[Axis::kY];
    const auto& now = machine.rows[i].axes[Axis::kY];
    if (before.mode == AxisMode::kVelocity && now.mode == AxisMode::kPosition) {
      changed = true;
      EXPECT_LE(std::fabs(now.duty_pct - before.duty_pct), 4.0);
      EXPECT_NEAR(now.reference_velocity_m_per_s, before.reference_velocity_m_per_s, 1e-3);
    }
  }
  EXPECT_TRUE(changed);
}

TEST(Defect9Goto, ATargetThatIsNeverReachedEndsWithAResultNotForEver) {
  Machine::Options options;
  options.configuration.go_to.timeout_s = 0.5;
  // Gains too weak to overcome friction.
  for (Axis axis : core::kPlanarAxes) {
    options.configuration.axes[axis].gains = {.proportional_Nm_per_rad = 1e-4,
                                              .integral_Nm_per_rad_s = 0,
                                              .derivative_Nm_s_per_rad = 1e-4};
  }
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_goto({.target_m = {{1.001, 0.301}}}));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.system().status().last_motion_result, ErrorCode::kMotionNotSettled);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
}

}  // namespace
}  // namespace towbench::tests
