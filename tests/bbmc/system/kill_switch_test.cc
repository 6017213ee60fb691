#include <cmath>

#include <gtest/gtest.h>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using bbmc::AxisMode;
using bbmc::SystemEvent;
using core::Axis;
using core::ErrorCode;

// Inside an exchange, away from any tick; after the first ticks at 1 Hz too.
constexpr double kPressed_s = 1.7503;
constexpr double kReleased_s = 2.2501;

Machine::Options options_at(double rate_Hz) {
  Machine::Options options;
  options.configuration.control_rate_Hz = rate_Hz;
  if (rate_Hz < 500) {
    for (Axis axis : core::kPlanarAxes) {
      options.configuration.axes[axis].gains =
          slow_gains(options.configuration.axes[axis], rate_Hz);
    }
  }
  options.events = {{.time_ns = core::nanoseconds(kPressed_s),
                     .kind = emulator::ScheduledEventKind::kPressKillSwitch},
                    {.time_ns = core::nanoseconds(kReleased_s),
                     .kind = emulator::ScheduledEventKind::kReleaseKillSwitch}};
  return options;
}

core::Nanoseconds edge_time(const Machine& machine) {
  for (const auto& event : machine.plant_events) {
    if (event.kind == emulator::PlantEventKind::kInputLineChanged &&
        (event.lines & protocol::mask_of(protocol::InputLine::kKillSwitch)) != 0) {
      return event.time_ns;
    }
  }
  return -1;
}

// From the edge: when the last duty was that was not zero.
double time_to_zero_duty(const Machine& machine) {
  core::Nanoseconds last_ns = 0;
  bool driven_before = false;
  for (const auto& duty : machine.duties) {
    const bool drives =
        duty.message.channel_a_ticks + duty.message.channel_b_ticks > 0 || duty.message.enable;
    if (!drives && driven_before && last_ns < edge_time(machine)) {
      last_ns = duty.time_ns;
    }
    driven_before = drives;
  }
  return core::seconds(last_ns - edge_time(machine));
}

void expect_dead_after_press(Machine& machine) {
  machine.run_for(kPressed_s + 0.01 - machine.time_s());
  const auto& status = machine.system().status();
  EXPECT_EQ(status.fault, ErrorCode::kFaultKillSwitch);
  EXPECT_TRUE(status.kill_switch_pressed);
  for (Axis axis : core::kPlanarAxes) {
    EXPECT_EQ(status.axes[axis].mode, AxisMode::kFaulted);
    EXPECT_EQ(status.axes[axis].duty_pct, 0.0);
    EXPECT_FALSE(status.axes[axis].amplifier_enabled);
  }
  const core::Nanoseconds edge_ns = edge_time(machine);
  for (const auto& duty : machine.duties) {
    if (duty.time_ns > edge_ns + 2 * core::kNanosecondsPerMillisecond) {
      EXPECT_EQ(duty.message.channel_a_ticks + duty.message.channel_b_ticks, 0);
      EXPECT_FALSE(duty.message.enable);
    }
  }
}

TEST(Defect3KillSwitch, ZeroDutyWithinTwoMillisecondsAtEveryControlRate) {
  for (const double rate_Hz : {1.0, 10.0, 1000.0, 5000.0}) {
    Machine machine(options_at(rate_Hz));
    ASSERT_TRUE(machine.system().request_open_loop(pulses(Axis::kY, 12, 8, true)));
    expect_dead_after_press(machine);
    EXPECT_GE(time_to_zero_duty(machine), 0.0) << rate_Hz;
    EXPECT_LE(time_to_zero_duty(machine), 2e-3) << rate_Hz;
  }
}

TEST(Defect2KillSwitch, IsHonouredInPositionControl) {
  for (const double rate_Hz : {10.0, 1000.0}) {
    Machine machine(options_at(rate_Hz));
    ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.05, 0.02)));
    expect_dead_after_press(machine);
  }
}

TEST(Defect2KillSwitch, IsHonouredInGoto) {
  Machine machine(options_at(1000));
  ASSERT_TRUE(machine.system().request_goto({.target_m = {{1.4, 0.4}}}));
  expect_dead_after_press(machine);
}

TEST(Defect2KillSwitch, IsHonouredWhileBraking) {
  Machine machine(options_at(1000));
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.9, 0.4)));
  machine.run_for(kPressed_s - 0.003);
  ASSERT_TRUE(machine.system().stop());
  machine.exchange();
  EXPECT_EQ(machine.status(Axis::kY).mode, AxisMode::kBraking);
  expect_dead_after_press(machine);
}

TEST(Defect2KillSwitch, IsLatchedWhenNothingMoves) {
  Machine machine(options_at(1000));
  expect_dead_after_press(machine);
}

TEST(Defect2KillSwitch, PressedAtPowerOnNothingMayMove) {
  auto options = options_at(1000);
  options.events = {{.time_ns = 0, .kind = emulator::ScheduledEventKind::kPressKillSwitch}};
  Machine machine(options);
  machine.run_for(0.05);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultKillSwitch);
  EXPECT_EQ(machine.system().request_open_loop(pulses(Axis::kY, 5)).error(),
            ErrorCode::kRequestSwitchPressed);
}

TEST(Defect2KillSwitch, NeedsAnExplicitResetWithTheSwitchReleased) {
  Machine machine(options_at(1000));
  ASSERT_TRUE(machine.system().request_open_loop(pulses(Axis::kY, 10)));
  expect_dead_after_press(machine);
  auto& system = machine.system();
  EXPECT_EQ(system.reset().error(), ErrorCode::kRequestSwitchPressed);
  machine.run_for(kReleased_s + 0.1 - machine.time_s());
  // Released, and still latched: nothing re-enables by itself.
  EXPECT_FALSE(system.status().kill_switch_pressed);
  EXPECT_EQ(system.status().fault, ErrorCode::kFaultKillSwitch);
  EXPECT_EQ(system.request_open_loop(pulses(Axis::kY, 10)).error(),
            ErrorCode::kRequestFaultLatched);
  ASSERT_TRUE(system.reset());
  EXPECT_EQ(system.status().axes[Axis::kY].mode, AxisMode::kIdle);
  EXPECT_TRUE(system.request_open_loop(pulses(Axis::kY, 10)));
  EXPECT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(system.status().fault, ErrorCode::kNone);
}

TEST(KillSwitch, APressAndReleaseInsideOneExchangeIsSeen) {
  auto options = options_at(1000);
  options.events[0].time_ns = core::nanoseconds(kPressed_s + 1e-4);
  options.events[1].time_ns = core::nanoseconds(kPressed_s + 5e-4);
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.9, 0.4)));
  machine.run_for(kPressed_s + 0.01);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultKillSwitch);
  EXPECT_FALSE(machine.status(Axis::kY).amplifier_enabled);
}

}  // namespace
}  // namespace towbench::tests
