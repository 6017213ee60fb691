// Ziegler-Nichols by relay: against a plant whose critical gain is known in closed form, and on the
// machine, where proportional control alone must die out below the gain found and not above.
#include "bbmc/system/relay_tuner.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using core::Axis;
using core::ErrorCode;

// 1 / (s (J s + B)) behind a delay: the phase is -180 deg where tan(w D) = B / (J w), and
// K_C = w sqrt((J w)^2 + B^2).
TEST(RelayTuner, FindsTheCriticalGainOfAMassWithDelayWithinTenPerCent) {
  constexpr double kInertia = 1.7e-5;
  constexpr double kDamping = 4e-4;
  constexpr double kDelay_s = 8e-3;
  constexpr double kStep_s = 1e-4;
  double w = 10;
  for (int i = 0; i < 200; ++i) {
    w = std::atan(kDamping / (kInertia * w)) / kDelay_s;
  }
  const double expected = w * std::sqrt(kInertia * w * kInertia * w + kDamping * kDamping);
  bbmc::RelayTuner tuner({.amplitude_rad = 0.5, .torque_Nm = 2e-3, .torque_limit_Nm = 1.0}, 0.0);
  std::deque<double> delayed(static_cast<std::size_t>(kDelay_s / kStep_s), 0.0);
  double angle = 0.01;
  double speed = 0;
  for (int i = 0; i < 2'000'000 && !tuner.over(); ++i) {
    delayed.push_back(tuner.step(angle, kStep_s));
    speed += kStep_s * (delayed.front() - kDamping * speed) / kInertia;
    angle += kStep_s * speed;
    delayed.pop_front();
  }
  ASSERT_TRUE(tuner.result().found());
  EXPECT_NEAR(tuner.result().amplitude_rad, 0.5, 0.03);
  // A describing function leaves the harmonics out; behind 1/s^2 and a delay that costs 8 %.
  EXPECT_NEAR(tuner.result().critical_gain_Nm_per_rad / expected, 1.0, 0.10);
  EXPECT_NEAR(tuner.result().critical_period_s * w / (2 * std::numbers::pi), 1.0, 0.06);
}

TEST(RelayTuner, GivesUpWhatDoesNotOscillate) {
  bbmc::RelayTuner stuck({}, 0.0);
  bbmc::RelayTuner gone({}, 0.0);
  double angle = 0;
  for (int i = 0; i < 10'000; ++i) {
    static_cast<void>(stuck.step(0.0, 1e-3));
    static_cast<void>(gone.step(angle += 0.1, 1e-3));
  }
  EXPECT_TRUE(stuck.over() && gone.over());
  EXPECT_FALSE(stuck.result().found() || gone.result().found());
  EXPECT_EQ(stuck.step(1.0, 1e-3), 0.0);
}

TEST(RelayTuner, Table4_1WithItsErrata) {
  const auto gains = bbmc::ziegler_nichols_pid({.critical_gain_Nm_per_rad = 1.0,
                                                .critical_period_s = 0.08,
                                                .amplitude_rad = 1,
                                                .relay_Nm = 1});
  EXPECT_DOUBLE_EQ(gains.proportional_Nm_per_rad, 0.6);
  EXPECT_DOUBLE_EQ(gains.integral_Nm_per_rad_s, 15.0);
  EXPECT_DOUBLE_EQ(gains.derivative_Nm_s_per_rad, 0.006);
}

// What a kick under proportional control alone has become of a second later: the swing of the
// motor, or true when it has built up so far that the machine was stopped.
struct AfterKick {
  double swing_m = 0;
  bool stopped = false;
};

AfterKick after_kick(Axis axis, double gain_Nm_per_rad) {
  Machine::Options options;
  options.configuration.axes[axis].gains = {.proportional_Nm_per_rad = gain_Nm_per_rad,
                                            .integral_Nm_per_rad_s = 0,
                                            .derivative_Nm_s_per_rad = 0};
  options.configuration.hold_time_s = 1.5;
  Machine machine(options);
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, axis, 1e-3, 0.2, 0.002)));
  machine.run_for(1.3);
  double lowest = 1e9;
  double highest = -1e9;
  for (std::size_t i = machine.rows.size() - 300; i < machine.rows.size(); ++i) {
    lowest = std::min(lowest, machine.rows[i].axes[axis].position_m);
    highest = std::max(highest, machine.rows[i].axes[axis].position_m);
  }
  return {(highest - lowest) / 2, machine.system().status().fault != ErrorCode::kNone};
}

class Tuning : public ::testing::TestWithParam<Axis> {};

TEST_P(Tuning, OnTheMachineTheGainFoundIsTheEdgeOfOscillationAndItsGainsHold) {
  const Axis axis = GetParam();
  Machine machine;
  ASSERT_TRUE(machine.system().request_tuning({.axis = axis, .amplitude_m = 5e-4}));
  ASSERT_TRUE(machine.run_until_rest(120.0));
  EXPECT_EQ(machine.system().status().last_motion_result, ErrorCode::kNone);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  const bbmc::RelayResult found = machine.status(axis).tuning;
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(found.amplitude_rad * bbmc::Configuration().axes[axis].metres_per_motor_rad(), 5e-4,
              2.5e-5);

  const AfterKick below = after_kick(axis, 0.7 * found.critical_gain_Nm_per_rad);
  EXPECT_FALSE(below.stopped);
  EXPECT_LT(below.swing_m, 2e-5);
  const AfterKick above = after_kick(axis, 1.4 * found.critical_gain_Nm_per_rad);
  EXPECT_TRUE(above.stopped || above.swing_m > 5e-4) << above.swing_m;

  const bbmc::ZieglerNicholsGains gains = bbmc::ziegler_nichols_pid(found);
  ASSERT_TRUE(
      machine.system().set_gains(axis, {.proportional_Nm_per_rad = gains.proportional_Nm_per_rad,
                                        .integral_Nm_per_rad_s = gains.integral_Nm_per_rad_s,
                                        .derivative_Nm_s_per_rad = gains.derivative_Nm_s_per_rad}));
  machine.rows.clear();
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, axis, 0.1, 0.1)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  double largest_m = 0;
  for (const auto& row : machine.rows) {
    const auto& state = row.axes[axis];
    largest_m = std::max(largest_m, std::fabs(state.reference_m - state.position_m));
  }
  EXPECT_LT(largest_m, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(BothAxes, Tuning, ::testing::ValuesIn(core::kPlanarAxes));

// Large oscillations: the relay turns the motor round while it runs, and what the encoder says of
// that is no fault of it.
TEST_P(Tuning, EveryAmplitudeThatTheCommandTakesIsReached) {
  const Axis axis = GetParam();
  for (const double amplitude_m : {2e-4, 3e-4, 5e-4, 7e-4, 8.5e-4, 1e-3}) {
    Machine machine;
    machine.keep_records = false;
    ASSERT_TRUE(machine.system().request_tuning({.axis = axis, .amplitude_m = amplitude_m}));
    ASSERT_TRUE(machine.run_until_rest(120.0));
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone) << amplitude_m;
    const bbmc::RelayResult found = machine.status(axis).tuning;
    ASSERT_TRUE(found.found()) << amplitude_m;
    EXPECT_NEAR(
        found.amplitude_rad * bbmc::Configuration().axes[axis].metres_per_motor_rad() / amplitude_m,
        1.0, 0.05);
  }
}

TEST(TuningRequest, RefusesWhatIsNoAmplitude) {
  Machine machine;
  for (const double amplitude_m : {0.0, -1e-3, 0.05, std::nan("")}) {
    EXPECT_EQ(machine.system().request_tuning({.amplitude_m = amplitude_m}).error(),
              ErrorCode::kRequestOutOfRange);
  }
  EXPECT_TRUE(machine.system().at_rest());
}

}  // namespace
}  // namespace towbench::tests
