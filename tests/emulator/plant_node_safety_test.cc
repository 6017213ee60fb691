#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;
using core::ErrorCode;
using protocol::InputLine;

constexpr core::Nanoseconds kMs = core::kNanosecondsPerMillisecond;

double y_current(const ScriptedController& c) {
  return c.peer.truth.back().axes[Axis::kY].current_A;
}

ScriptedController driven(const RigParameters& rig, std::vector<ScheduledEvent> events = {}) {
  return ScriptedController(rig, std::move(events));
}

TEST(PlantNodeSafety, NothingFlowsBeforeTheAmplifierIsEnabled) {
  auto c = driven(rig_starting_at(1.0, 0.3));
  c.greet();
  c.drive(Axis::kY, 300);
  c.run_for(20 * kMs);
  EXPECT_EQ(y_current(c), 0.0);
  c.enable(mask_of(protocol::OutputLine::kAmplifierEnableY));
  c.run_for(20 * kMs);
  EXPECT_GT(y_current(c), 0.5);
  EXPECT_EQ(c.peer.truth.back().axes[Axis::kX].current_A, 0.0);
}

// 20 kHz a channel is 80,000 counts/s, which Y passes at 0.18 m/s.
TEST(PlantNodeSafety, AnEncoderFasterThanItsChannelsCarryIsReportedOnceAndLosesNoEdge) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.axes[Axis::kY].encoder.max_channel_Hz = 20e3;
  rig.axes[Axis::kY].plant.elasticity.rigid = true;  // passes it once, without swinging
  auto c = driven(rig);
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.run_for(300 * kMs);
  const auto faults = c.peer.all<protocol::Fault>();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, ErrorCode::kEncoderRateExceeded);
  const AxisTruth y = c.peer.truth.back().axes[Axis::kY];
  ASSERT_GT(y.motor_speed_rad_per_s * 4000.0 / (2.0 * std::numbers::pi), 80e3);
  EXPECT_EQ(y.count, static_cast<std::int64_t>(
                         std::floor(y.motor_angle_rad * 4000.0 / (2.0 * std::numbers::pi))));
}

TEST(PlantNodeSafety, LosingThePeerRemovesTheDriveAndEnds) {
  auto c = driven(rig_starting_at(1.0, 0.3));
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.run_for(20 * kMs);
  c.peer.forget();
  c.plant.peer_lost(ErrorCode::kPeerSilent);
  ASSERT_EQ(c.peer.events.size(), 2U);
  EXPECT_EQ(c.peer.events[0].kind, PlantEventKind::kPeerLost);
  EXPECT_EQ(c.peer.events[0].code, ErrorCode::kPeerSilent);
  EXPECT_EQ(c.peer.events[1].kind, PlantEventKind::kDriveRemoved);
  EXPECT_TRUE(c.plant.finished());
  c.plant.peer_lost(ErrorCode::kPeerClosed);  // a second carrier error says nothing new
  EXPECT_EQ(c.peer.events.size(), 2U);
}

TEST(PlantNodeSafety, ByeIsAnsweredOnceAndNothingIsServedAfterIt) {
  auto c = driven(rig_starting_at(1.0, 0.3));
  c.greet();
  c.peer.forget();
  c.plant.on(protocol::Bye{});
  c.plant.on(protocol::Bye{});
  c.advance_by(kMs);
  c.drive(Axis::kY, 300);
  c.greet();
  EXPECT_EQ(c.peer.order(), "Bye");
  EXPECT_TRUE(c.plant.finished());
  EXPECT_EQ(c.peer.all(PlantEventKind::kFinished).size(), 1U);
}

TEST(PlantNodeSafety, TheKillSwitchIsALineAndLeavesTheDriveToTheController) {
  auto c = driven(rig_starting_at(1.0, 0.3),
                  {{.time_ns = 5'000'001, .kind = ScheduledEventKind::kPressKillSwitch},
                   {.time_ns = 9'000'000, .kind = ScheduledEventKind::kReleaseKillSwitch}});
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.peer.forget();
  c.run_for(20 * kMs);
  const auto inputs = c.peer.all<protocol::DigitalInputs>();
  ASSERT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs[0].change_ns, 5'000'001);
  EXPECT_NE(inputs[0].lines & mask_of(InputLine::kKillSwitch), 0);
  EXPECT_EQ(inputs[1].change_ns, 9'000'000);
  EXPECT_EQ(inputs[1].lines & mask_of(InputLine::kKillSwitch), 0);
  EXPECT_EQ(inputs[1].sequence, inputs[0].sequence + 1);
  EXPECT_GT(y_current(c), 0.5);
  EXPECT_EQ(c.peer.all(PlantEventKind::kScheduledEventFired).size(), 2U);
}

TEST(PlantNodeSafety, AKillContactInTheAmplifiersEnableCutsTheCurrentWhilePressed) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.kill_switch.cuts_amplifiers = true;
  auto c = driven(rig, {{.time_ns = 20 * kMs, .kind = ScheduledEventKind::kPressKillSwitch},
                        {.time_ns = 40 * kMs, .kind = ScheduledEventKind::kReleaseKillSwitch}});
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.run_for(20 * kMs);
  EXPECT_GT(y_current(c), 0.5);
  c.run_for(2 * kMs);
  EXPECT_EQ(y_current(c), 0.0);
  c.run_for(25 * kMs);
  EXPECT_GT(y_current(c), 0.5);
}

TEST(PlantNodeSafety, ABouncingKillContactIsReportedBounceByBounceInOrder) {
  std::vector<ScheduledEvent> bounces;
  for (int i = 0; i < 200; ++i) {
    bounces.push_back({.time_ns = kMs + i * 1'000,
                       .kind = i % 2 == 0 ? ScheduledEventKind::kPressKillSwitch
                                          : ScheduledEventKind::kReleaseKillSwitch});
  }
  auto c = driven(rig_starting_at(1.0, 0.3), bounces);
  c.greet();
  c.peer.forget();
  c.run_for(20 * kMs, 20 * kMs);
  const auto inputs = c.peer.all<protocol::DigitalInputs>();
  ASSERT_EQ(inputs.size(), 200U);
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    EXPECT_GE(inputs[i].change_ns, inputs[i - 1].change_ns);
    EXPECT_EQ(inputs[i].sequence, inputs[i - 1].sequence + 1);
    EXPECT_EQ((inputs[i].lines & mask_of(InputLine::kKillSwitch)) != 0, i % 2 == 0);
  }
}

TEST(PlantNodeSafety, RunningIntoTheEndGivesTheHallEdgeThenTheContactWithItsSpeed) {
  const RigParameters rig = rig_starting_at(3.6, 0.3);
  auto c = driven(rig);
  c.greet();
  c.enable();
  c.drive(Axis::kY, 150);
  c.peer.forget();
  c.run_for(2000 * kMs);
  const auto contacts = c.peer.all(PlantEventKind::kHardEndContact);
  ASSERT_FALSE(contacts.empty());
  EXPECT_GT(contacts[0].value, 0.2);
  EXPECT_GT(contacts[0].energy_J, 0.0);
  const auto lines = c.peer.all(PlantEventKind::kInputLineChanged);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].lines & mask_of(InputLine::kHallYMax), mask_of(InputLine::kHallYMax));
  EXPECT_LT(lines[0].time_ns, contacts[0].time_ns);
  // The hall line changes its delay after the carriage has passed it: bracketed by truth rows.
  const double hall_m = rig.axes[Axis::kY].hall_max.position_m;
  const core::Nanoseconds passed_ns =
      lines[0].time_ns - core::nanoseconds(rig.axes[Axis::kY].hall_max.delay_s);
  for (std::size_t i = 1; i < c.peer.truth.size(); ++i) {
    if (c.peer.truth[i].time_ns >= passed_ns) {
      EXPECT_LE(c.peer.truth[i - 1].axes[Axis::kY].carriage_m, hall_m);
      EXPECT_GE(c.peer.truth[i].axes[Axis::kY].carriage_m, hall_m);
      break;
    }
  }
  EXPECT_LE(c.peer.truth.back().axes[Axis::kY].carriage_m,
            rig.axes[Axis::kY].plant.hard_ends.max_m + 2e-3);
}

TEST(PlantNodeSafety, AnOverloadedSupplyTripsTakesReadyAwayAndStaysOff) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.supply.over_current_A = 0.3;
  auto c = driven(rig);
  c.greet();
  c.enable();
  c.drive(Axis::kY, 1000);
  c.peer.forget();
  c.run_for(100 * kMs);
  ASSERT_FALSE(c.peer.all<protocol::Fault>().empty());
  EXPECT_EQ(c.peer.all<protocol::Fault>()[0].code, ErrorCode::kSupplyOverCurrent);
  EXPECT_EQ(c.peer.all<protocol::DigitalInputs>().back().lines &
                (mask_of(InputLine::kAmplifierReadyY) | mask_of(InputLine::kAmplifierReadyX)),
            0);
  EXPECT_EQ(y_current(c), 0.0);
}

}  // namespace
}  // namespace towbench::emulator
