// An absolute encoder's counts: who is sent them, that they are the true place, and what of the
// encoder's faults reaches them. Judged by the floor of the truth's place over the resolution.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;
using protocol::AbsoluteCount;
using protocol::EncoderLine;

constexpr core::Nanoseconds kTurn_ns = core::kNanosecondsPerMillisecond;

// Y's is absolute, and so near its zero that it passes it.
RigParameters rig_telling(EncoderSide side) {
  RigParameters rig = rig_starting_at(0.002, 0.3);
  rig.axes[Axis::kY].encoder.side = side;
  rig.axes[Axis::kY].encoder.absolute = true;
  rig.axes[Axis::kY].plant.hard_ends.fitted = false;
  return rig;
}

protocol::Hello asking() {
  auto hello = ScriptedController::hello();
  hello.capabilities |= protocol::kCapabilityAbsolute;
  return hello;
}

// Of the truth, in counts.
double true_place(const RigParameters& rig, const AxisTruth& truth) {
  const RigAxisParameters& y = rig.axes[Axis::kY];
  const double turn = static_cast<double>(y.encoder.counts_per_turn);
  return y.encoder.side == EncoderSide::kLoad
             ? truth.carriage_m * turn * y.plant.gear_ratio /
                   (2.0 * std::numbers::pi * y.plant.output_radius_m)
             : truth.motor_angle_rad * turn / (2.0 * std::numbers::pi);
}

// Where the place is within rounding of a whole count either side is right.
void expect_floor_of(double place, std::int64_t told, const std::string& when) {
  if (std::fabs(place - std::round(place)) > 1e-6) {
    ASSERT_EQ(told, static_cast<std::int64_t>(std::floor(place))) << when;
  }
}

// Towards min through zero, and back.
void move_about(ScriptedController& c, int exchanges = 400) {
  c.enable();
  for (int i = 0; i < exchanges; ++i) {
    c.drive(Axis::kY, static_cast<int>(-300 * std::sin(0.02 * i)));
    c.advance_by(kTurn_ns);
  }
}

TEST(AbsoluteEncoder, IsOfferedWhereThereIsOneAndSentToWhomAsksForIt) {
  for (const bool has : {true, false}) {
    for (const bool asks : {true, false}) {
      RigParameters rig = rig_telling(EncoderSide::kMotor);
      rig.axes[Axis::kY].encoder.absolute = has;
      ScriptedController c(rig);
      c.greet(asks ? asking() : ScriptedController::hello());
      const auto reply = c.peer.all<protocol::HelloReply>().at(0);
      EXPECT_EQ((reply.plant.capabilities & protocol::kCapabilityAbsolute) != 0, has);
      EXPECT_EQ(reply.refusal, core::ErrorCode::kNone);
      const bool sent = has && asks;
      EXPECT_EQ(c.peer.order(), sent ? "HelloReply Inputs AbsoluteY" : "HelloReply Inputs");
      c.peer.forget();
      c.advance_by(kTurn_ns);
      EXPECT_EQ(c.peer.order(),
                sent ? "EdgesY AbsoluteY EdgesX Advanced" : "EdgesY EdgesX Advanced");
    }
  }
}

TEST(AbsoluteEncoder, ComesBehindTheDigestToo) {
  RigParameters rig = rig_telling(EncoderSide::kMotor);
  rig.axes[Axis::kX].encoder.absolute = true;
  ScriptedController c(rig);
  auto hello = asking();
  hello.capabilities = protocol::kCapabilityDigest | protocol::kCapabilityAbsolute;
  c.greet(hello);
  c.peer.forget();
  c.advance_by(kTurn_ns);
  EXPECT_EQ(c.peer.order(), "ReportY AbsoluteY ReportX AbsoluteX Advanced");
}

TEST(AbsoluteEncoder, TellsTheFloorOfTheTruePlaceOnEitherSide) {
  for (const EncoderSide side : {EncoderSide::kMotor, EncoderSide::kLoad}) {
    const RigParameters rig = rig_telling(side);
    ScriptedController c(rig);
    c.greet(asking());
    const double start = 0.002 / metres_per_count(rig.axes[Axis::kY]);
    expect_floor_of(start, c.peer.all<AbsoluteCount>().at(0).count, "before anything moves");
    c.peer.forget();
    move_about(c);
    const auto told = c.peer.all<AbsoluteCount>();
    ASSERT_EQ(told.size(), c.peer.truth.size());
    std::int32_t least = 0;
    std::int32_t most = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      ASSERT_EQ(told[i].time_ns, c.peer.truth[i].time_ns);
      ASSERT_EQ(told[i].sequence, i + 1);
      const AxisTruth& truth = c.peer.truth[i].axes[Axis::kY];
      expect_floor_of(true_place(rig, truth), told[i].count, std::to_string(i));
      ASSERT_EQ(truth.absolute_count, told[i].count);
      least = std::min(least, told[i].count);
      most = std::max(most, told[i].count);
    }
    EXPECT_LT(least, -1000) << "a machine that stays above zero shows half";
    EXPECT_GT(most, 400);
  }
}

// Whoever comes later knows the place at once.
TEST(AbsoluteEncoder, TellsTheNextControllerWhereTheAxisStands) {
  const RigParameters rig = rig_telling(EncoderSide::kLoad);
  ScriptedController c(rig);
  c.greet(asking());
  move_about(c, 100);
  const double place = true_place(rig, c.peer.truth.back().axes[Axis::kY]);
  c.peer.forget();
  c.greet(asking());
  const auto told = c.peer.all<AbsoluteCount>();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].sequence, 0U);
  EXPECT_EQ(told[0].time_ns, 100 * kTurn_ns);
  expect_floor_of(place, told[0].count, "after the second greeting");
  EXPECT_LT(told[0].count, 0);
}

// How far what is told is from the floor of the true place, at the end.
double told_beyond_truth(const RigParameters& rig, const ScriptedController& c) {
  return c.peer.all<AbsoluteCount>().back().count -
         std::floor(true_place(rig, c.peer.truth.back().axes[Axis::kY]));
}

TEST(AbsoluteEncoder, BrokenLinesLeaveItAlone) {
  const auto line = [](EncoderLine which, WireCondition condition) {
    return ScheduledEvent{.time_ns = 50 * kTurn_ns,
                          .kind = ScheduledEventKind::kRewireEncoder,
                          .encoder_line = which,
                          .condition = condition};
  };
  const ScheduledEvent swapped{
      .time_ns = 50 * kTurn_ns, .kind = ScheduledEventKind::kSwapEncoderChannels, .value = 1.0};
  for (const ScheduledEvent& event : {line(EncoderLine::kA, WireCondition::kStuckLow),
                                      line(EncoderLine::kB, WireCondition::kStuckHigh),
                                      line(EncoderLine::kIndex, WireCondition::kStuckLow),
                                      line(EncoderLine::kA, WireCondition::kInverted), swapped}) {
    const RigParameters rig = rig_telling(EncoderSide::kMotor);
    ScriptedController c(rig, {event});
    c.greet(asking());
    move_about(c);
    EXPECT_EQ(told_beyond_truth(rig, c), 0.0);
  }
}

TEST(AbsoluteEncoder, LinesOutOfPlaceLeaveItAlone) {
  for (const double phase_deg : {30.0, 150.0}) {
    RigParameters rig = rig_telling(EncoderSide::kLoad);
    rig.axes[Axis::kY].encoder.phase_deg = phase_deg;
    ScriptedController c(rig);
    c.greet(asking());
    c.peer.forget();
    move_about(c);
    const auto told = c.peer.all<AbsoluteCount>();
    int lines_differ = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      const AxisTruth& truth = c.peer.truth[i].axes[Axis::kY];
      expect_floor_of(true_place(rig, truth), told[i].count, std::to_string(i));
      lines_differ += truth.count != told[i].count ? 1 : 0;
    }
    EXPECT_GT(lines_differ, 20) << "lines in place prove nothing";
  }
}

TEST(AbsoluteEncoder, ADiscThatTurnsOrSlipsTakesItAlong) {
  for (const EncoderSide side : {EncoderSide::kMotor, EncoderSide::kLoad}) {
    const RigParameters rig = rig_telling(side);
    ScriptedController turned(
        rig, {{.time_ns = 50 * kTurn_ns, .kind = ScheduledEventKind::kTurnDisc, .value = -1700.0}});
    turned.greet(asking());
    move_about(turned);
    EXPECT_EQ(told_beyond_truth(rig, turned), -1700.0);

    // Towards min all the time: what the shaft does and the disc does not.
    ScriptedController slipped(
        rig, {{.time_ns = 50 * kTurn_ns, .kind = ScheduledEventKind::kSlipDisc, .value = 300.0}});
    slipped.greet(asking());
    move_about(slipped, 120);
    EXPECT_EQ(told_beyond_truth(rig, slipped), 300.0);
  }
}

TEST(AbsoluteEncoder, HeldItTellsTheSameAndAfterwardsThePlace) {
  const RigParameters rig = rig_telling(EncoderSide::kLoad);
  ScriptedController c(
      rig, {{.time_ns = 50 * kTurn_ns, .kind = ScheduledEventKind::kHoldAbsolute, .value = 1.0},
            {.time_ns = 90 * kTurn_ns, .kind = ScheduledEventKind::kHoldAbsolute, .value = 0.0}});
  c.greet(asking());
  c.peer.forget();
  move_about(c, 100);
  const auto told = c.peer.all<AbsoluteCount>();
  for (std::size_t i = 49; i < 90; ++i) {
    ASSERT_EQ(told[i].count, told[49].count) << i;
    ASSERT_EQ(told[i].sequence, i + 1) << "who is held speaks on";
  }
  EXPECT_LT(told[90].count, told[49].count - 100);
  EXPECT_EQ(told_beyond_truth(rig, c), 0.0);
}

TEST(AbsoluteEncoder, ChangesNoBitOfTheMachine) {
  const auto run = [](bool absolute) {
    RigParameters rig = rig_telling(EncoderSide::kMotor);
    rig.axes[Axis::kY].encoder.absolute = absolute;
    ScriptedController c(rig);
    c.greet(asking());
    move_about(c, 100);
    return c.peer.truth.back().axes[Axis::kY].motor_angle_rad;
  };
  EXPECT_EQ(run(true), run(false));
}

}  // namespace
}  // namespace towbench::emulator
