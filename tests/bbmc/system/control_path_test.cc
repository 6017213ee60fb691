// Properties of the control path as a whole.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"
#include "tests/support/allocation_guard.h"

namespace towbench::tests {
namespace {

using bbmc::AxisMode;
using core::Axis;
using core::ErrorCode;

TEST(ControlPath, TakesNoHeapFromSampleInToDutyOut) {
  Machine machine;
  machine.keep_records = false;
  machine.run_for(0.01);
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.3)));
  struct Sink final : protocol::MessageSink {
  } nowhere;
  core::Nanoseconds now_ns = core::nanoseconds(machine.time_s());
  std::uint32_t sequence = 10;
  {
    const AllocationGuard guard;
    // Idle plant: the law winds against a count that stands, until plausibility stops it; a kill
    // press and its release pass through the interrupt path.
    for (int k = 0; k < 2'000; ++k) {
      now_ns += core::kNanosecondsPerMillisecond;
      machine.board().set_time(now_ns);
      protocol::DigitalInputs inputs;
      inputs.lines = k == 300 ? protocol::mask_of(protocol::InputLine::kKillSwitch) : 0;
      inputs.change_ns = now_ns;
      inputs.sequence = sequence++;
      static_cast<void>(machine.board().take(inputs));
      machine.system().service(now_ns);
      machine.board().flush(nowhere);
      bbmc::TelemetryRow row;
      while (machine.system().next_row(row)) {
      }
    }
  }
  EXPECT_NE(machine.system().status().fault, ErrorCode::kNone);
}

TEST(ControlPath, IsDeterministic) {
  const auto run = [] {
    Machine machine;
    EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.2, 0.3)));
    EXPECT_TRUE(machine.run_until_rest(10.0));
    std::vector<double> log;
    for (const auto& row : machine.rows) {
      for (const auto& axis : row.axes) {
        log.insert(log.end(), {axis.duty_pct, axis.velocity_m_per_s, axis.position_m});
      }
    }
    return log;
  };
  EXPECT_EQ(run(), run());
}

TEST(ControlPath, OneRowAControlTickWithTheEdgesThatCameSince) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.2, 0.3)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  std::int64_t edges = 0;
  for (std::size_t i = 0; i < machine.rows.size(); ++i) {
    EXPECT_EQ(machine.rows[i].time_ns,
              static_cast<core::Nanoseconds>(i) * core::kNanosecondsPerMillisecond);
    edges += machine.rows[i].axes[Axis::kY].edges;
  }
  EXPECT_EQ(edges, machine.truth.back().axes[Axis::kY].edges_total);
  EXPECT_EQ(machine.system().rows_lost(), 0U);
}

TEST(ControlPath, TracksFourHundredMillimetresPerSecondWithinAMillimetre) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 1.2, 0.4)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.system().status().last_motion_result, ErrorCode::kNone);
  double peak_m = 0;
  for (const auto& row : machine.rows) {
    if (row.axes[Axis::kY].mode == AxisMode::kPosition) {
      peak_m = std::max(peak_m,
                        std::fabs(row.axes[Axis::kY].reference_m - row.axes[Axis::kY].position_m));
    }
  }
  EXPECT_GT(peak_m, 1e-5);  // too good would mean that nothing was measured
  EXPECT_LT(peak_m, 1e-3);
  EXPECT_NEAR(machine.truth.back().axes[Axis::kY].carriage_m, 2.2, 3e-3);
}

TEST(ControlPath, RunsAtEveryRateFromOneHertzToFiveKilohertz) {
  for (const double rate_Hz : {1.0, 10.0, 100.0, 1000.0, 2000.0, 5000.0}) {
    Machine::Options options;
    options.configuration.control_rate_Hz = rate_Hz;
    for (Axis axis : core::kPlanarAxes) {
      auto& settings = options.configuration.axes[axis];
      if (rate_Hz < 1000) {
        settings.gains = slow_gains(settings, rate_Hz);
      }
    }
    Machine machine(options);
    ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.01, 0.01)))
        << rate_Hz;
    ASSERT_TRUE(machine.run_until_rest(20.0)) << rate_Hz;
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone) << rate_Hz;
    EXPECT_EQ(machine.system().status().control_ticks, machine.rows.size()) << rate_Hz;
    EXPECT_EQ(machine.system().perf_log().lateness().max_ns, 0) << rate_Hz;
  }
}

TEST(LocalState, IsRelativeToWhereTheLastMotionBegan) {
  Machine machine;
  const auto before = machine.status(Axis::kY).count;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.05, 0.1)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  const auto& status = machine.status(Axis::kY);
  EXPECT_EQ(status.local_count, status.count - before);
  EXPECT_NEAR(static_cast<double>(status.local_count), 0.05 * 445'345, 10);
}

TEST(SystemStates, AMotionWalksFromIdleThroughItsModeBackToIdle) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.05, 0.1)));
  EXPECT_FALSE(machine.system().at_rest());
  ASSERT_TRUE(machine.run_until_rest(10.0));
  std::vector<std::int64_t> modes;
  for (const auto& event : machine.events) {
    if (event.kind == bbmc::SystemEvent::Kind::kStateChanged && event.axis == Axis::kY) {
      modes.push_back(event.value);
    }
  }
  EXPECT_EQ(modes, (std::vector<std::int64_t>{static_cast<std::int64_t>(AxisMode::kPosition),
                                              static_cast<std::int64_t>(AxisMode::kIdle)}));
}

TEST(LinkLost, NoSamplesForLongerThanTheTimeOutBrakeBlindAndThenRemoveTheDrive) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.5, 0.3)));
  machine.run_for(0.7);
  ASSERT_TRUE(machine.status(Axis::kY).amplifier_enabled);
  core::Nanoseconds now_ns = core::nanoseconds(machine.time_s());
  bool braked = false;
  for (int k = 0; k < 150; ++k) {  // 20 ms of patience; 0.1 s of braking from 0.3 m/s is enough
    now_ns += core::kNanosecondsPerMillisecond;
    machine.board().set_time(now_ns);
    machine.system().service(now_ns);
    braked = braked || machine.status(Axis::kY).duty_pct < 0.0;
  }
  EXPECT_NE(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_TRUE(braked);
  EXPECT_FALSE(machine.status(Axis::kY).amplifier_enabled);
  EXPECT_EQ(machine.status(Axis::kY).duty_pct, 0.0);
}

TEST(LinkLost, NoSamplesWhileCreepingRemoveTheDriveAtOnce) {
  Machine machine;
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.02, 0.005)));
  machine.run_for(0.7);
  core::Nanoseconds now_ns = core::nanoseconds(machine.time_s());
  for (int k = 0; k < 25; ++k) {
    now_ns += core::kNanosecondsPerMillisecond;
    machine.board().set_time(now_ns);
    machine.system().service(now_ns);
  }
  EXPECT_NE(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_FALSE(machine.status(Axis::kY).amplifier_enabled);
  EXPECT_EQ(machine.status(Axis::kY).duty_pct, 0.0);
}

}  // namespace
}  // namespace towbench::tests
