#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;
using protocol::InputLine;

constexpr core::Nanoseconds kMillisecond = core::kNanosecondsPerMillisecond;

ScheduledEvent rewire(core::Nanoseconds time_ns, InputLine line, WireCondition condition) {
  return {.time_ns = time_ns,
          .kind = ScheduledEventKind::kRewireInput,
          .input_line = line,
          .condition = condition};
}

TEST(PlantNodeWiring, AKillSwitchWithABrokenWireIsNotSeenButStillCutsInHardware) {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  rig.kill_switch.cuts_amplifiers = true;
  ScriptedController c(
      rig, {rewire(0, InputLine::kKillSwitch, WireCondition::kStuckLow),
            {.time_ns = 5 * kMillisecond, .kind = ScheduledEventKind::kPressKillSwitch}});
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.peer.forget();
  c.run_for(20 * kMillisecond);
  EXPECT_TRUE(c.peer.all<protocol::DigitalInputs>().empty());
  EXPECT_EQ(c.peer.truth.back().axes[Axis::kY].current_A, 0.0);
}

TEST(PlantNodeWiring, AShortedHallLineIsActiveAtThatNanosecondAndGoesBackWhenCleared) {
  ScriptedController c(rig_starting_at(1.0, 0.3),
                       {rewire(1'500'001, InputLine::kHallXMax, WireCondition::kStuckHigh),
                        rewire(7'000'000, InputLine::kHallXMax, WireCondition::kIntact)});
  c.greet();
  c.peer.forget();
  c.run_for(20 * kMillisecond);
  const auto inputs = c.peer.all<protocol::DigitalInputs>();
  ASSERT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs[0].change_ns, 1'500'001);
  EXPECT_NE(inputs[0].lines & mask_of(InputLine::kHallXMax), 0);
  EXPECT_EQ(inputs[1].change_ns, 7'000'000);
  EXPECT_EQ(inputs[1].lines & mask_of(InputLine::kHallXMax), 0);
}

TEST(PlantNodeWiring, AnInvertedLineReportsEachChangeTheOtherWayRound) {
  ScriptedController c(
      rig_starting_at(1.0, 0.3),
      {rewire(1 * kMillisecond, InputLine::kKillSwitch, WireCondition::kInverted),
       {.time_ns = 2 * kMillisecond, .kind = ScheduledEventKind::kPressKillSwitch},
       {.time_ns = 3 * kMillisecond, .kind = ScheduledEventKind::kReleaseKillSwitch}});
  c.greet();
  c.peer.forget();
  c.run_for(5 * kMillisecond);
  const auto inputs = c.peer.all<protocol::DigitalInputs>();
  ASSERT_EQ(inputs.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((inputs[i].lines & mask_of(InputLine::kKillSwitch)) != 0, i != 1);
  }
}

TEST(PlantNodeWiring, ADeadEncoderWireLeavesTheTrueCountAndTheEdgesSentApart) {
  ScriptedController c(rig_starting_at(1.0, 0.3), {{.time_ns = 50 * kMillisecond,
                                                    .kind = ScheduledEventKind::kRewireEncoder,
                                                    .axis = Axis::kY,
                                                    .encoder_line = protocol::EncoderLine::kA,
                                                    .condition = WireCondition::kStuckLow}});
  c.greet();
  c.enable();
  c.drive(Axis::kY, 300);
  c.run_for(200 * kMillisecond);
  std::int64_t sent = 0;
  for (const auto& m : c.peer.all<EdgeInterval>()) {
    for (const protocol::EncoderEdge edge : m.edges) {
      sent += m.axis == Axis::kY && edge.line() != protocol::EncoderLine::kIndex ? 1 : 0;
    }
  }
  const AxisTruth& y = c.peer.truth.back().axes[Axis::kY];
  EXPECT_EQ(sent, y.edges_total);
  EXPECT_LT(sent, (y.count - c.peer.truth.front().axes[Axis::kY].count) * 3 / 4);
}

}  // namespace
}  // namespace towbench::emulator
