// Defects that the fault campaign found in this controller, each by its case.
#include <algorithm>
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
using emulator::ScheduledEvent;
using emulator::ScheduledEventKind;

// trapezoid-x/amplifier.x.inverted/accelerate/1: the brake of an inverted amplifier drove X at full
// speed for its whole time-out, into the hard end.
TEST(CampaignDefect, ABrakeThatDoesNotSlowTheAxisGivesTheDriveUp) {
  Machine::Options options;
  options.start_m = {{1.0, 0.5}};
  options.events.push_back({.time_ns = 350'000'000,
                            .kind = ScheduledEventKind::kScaleCommand,
                            .axis = Axis::kX,
                            .value = -1.0});
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kX, -0.25, 0.25)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  const SystemEvent* fault = machine.find(SystemEvent::Kind::kFaultLatched);
  ASSERT_NE(fault, nullptr);
  // Stand-still time at full torque is 10 ms; a swing of the chain is allowed for.
  const auto last_driven =
      std::find_if(machine.rows.rbegin(), machine.rows.rend(),
                   [](const auto& row) { return row.axes[Axis::kX].duty_pct != 0.0; });
  ASSERT_NE(last_driven, machine.rows.rend());
  EXPECT_LE(core::seconds(last_driven->time_ns - fault->time_ns), 0.25);
  for (const auto& event : machine.plant_events) {
    EXPECT_NE(event.kind, emulator::PlantEventKind::kHardEndContact);
  }
}

// end-y-max/encoder.y.index_missing/cruise: a lost index took the brake away, and the carriage
// coasted into the hard end although every count was there.
TEST(CampaignDefect, ALostIndexBrakesInsteadOfCoasting) {
  Machine::Options options;
  options.start_m[Axis::kY] = 3.0;
  options.events.push_back({.time_ns = 800'000'000,
                            .kind = ScheduledEventKind::kRewireEncoder,
                            .axis = Axis::kY,
                            .encoder_line = protocol::EncoderLine::kIndex,
                            .condition = emulator::WireCondition::kStuckLow});
  Machine machine(options);
  ASSERT_TRUE(machine.system().calibrate_position(Axis::kY, 100'000));
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 1.2, 0.5)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  machine.run_for(0.5);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultEncoderIndex);
  EXPECT_EQ(machine.status(Axis::kY).mode, AxisMode::kFaulted);
  EXPECT_LT(machine.truth.back().axes[Axis::kY].carriage_m, 3.6);
  EXPECT_LT(std::fabs(machine.truth.back().axes[Axis::kY].carriage_speed_m_per_s), 1e-3);
}

}  // namespace
}  // namespace towbench::tests
