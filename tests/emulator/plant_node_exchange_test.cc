#include <cmath>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"
#include "tests/emulator/sensors/reference_decoder.h"

namespace towbench::emulator {
namespace {

using core::Axis;
using core::ErrorCode;
using protocol::InputLine;

ScriptedController greeted(const RigParameters& rig, std::vector<ScheduledEvent> events = {}) {
  return ScriptedController(rig, std::move(events));
}

TEST(PlantNodeExchange, SendsEdgesOfEveryAxisThenLinesThenAdvanced) {
  auto c = greeted(rig_starting_at(1.0, 0.3),
                   {{.time_ns = 1'234'567, .kind = ScheduledEventKind::kPressKillSwitch}});
  c.greet();
  c.peer.forget();
  c.advance_by(1'000'000);
  EXPECT_EQ(c.peer.order(), "EdgesY EdgesX Advanced");
  c.peer.forget();
  c.advance_by(1'000'000);
  EXPECT_EQ(c.peer.order(), "EdgesY EdgesX Inputs Advanced");
  const auto inputs = c.peer.all<protocol::DigitalInputs>().at(0);
  EXPECT_EQ(inputs.change_ns, 1'234'567);
  EXPECT_NE(inputs.lines & mask_of(InputLine::kKillSwitch), 0);
  EXPECT_EQ(c.peer.all<protocol::Advanced>().at(0).time_ns, 2'000'000);
  EXPECT_EQ(c.peer.truth.size(), 1U);
  EXPECT_EQ(c.peer.truth[0].time_ns, 2'000'000);
}

TEST(PlantNodeExchange, TheOperatorsResetComesBehindTheLinesToAControllerThatTakesIt) {
  const std::vector<ScheduledEvent> acts{
      {.time_ns = 1'000'001, .kind = ScheduledEventKind::kReleaseKillSwitch},
      {.time_ns = 1'234'567, .kind = ScheduledEventKind::kPressKillSwitch},
      {.time_ns = 1'700'000, .kind = ScheduledEventKind::kReset}};
  for (const bool takes : {true, false}) {
    auto c = greeted(rig_starting_at(1.0, 0.3), acts);
    auto hello = ScriptedController::hello();
    hello.capabilities |= takes ? protocol::kCapabilityReset : 0;
    c.greet(hello);
    c.advance_by(1'000'000);
    c.peer.forget();
    c.advance_by(1'000'000);
    EXPECT_EQ(c.peer.order(),
              takes ? "EdgesY EdgesX Inputs Reset Advanced" : "EdgesY EdgesX Inputs Advanced");
    const auto told = c.peer.all(PlantEventKind::kOperatorReset);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].time_ns, 1'700'000);
    EXPECT_EQ(told[0].value, takes ? 1.0 : 0.0);
    c.advance_by(1'000'000);
    EXPECT_EQ(c.peer.all<protocol::Reset>().size(), takes ? 1U : 0U);
  }
}

TEST(PlantNodeExchange, TheEdgesAddUpToTheTrueCountWithoutGapOrOverlap) {
  auto c = greeted(rig_starting_at(1.0, 0.2));
  c.greet();
  c.enable();
  core::PerPlanarAxis<std::int64_t> start{};
  c.advance_by(100'000);
  core::PerPlanarAxis<ReferenceDecoder> decoders{{ReferenceDecoder(0, 0), ReferenceDecoder(0, 0)}};
  for (const auto& m : c.peer.all<EdgeInterval>()) {
    start[m.axis] = c.peer.truth[0].axes[m.axis].count;
    decoders[m.axis] = ReferenceDecoder(m.start_levels, start[m.axis]);
    ASSERT_TRUE(m.edges.empty());
  }
  c.peer.forget();
  for (int i = 0; i < 400; ++i) {
    c.drive(Axis::kY, static_cast<int>(300 * std::sin(0.05 * i)));
    c.drive(Axis::kX, static_cast<int>(100 * std::cos(0.09 * i)));
    c.advance_by(1'000'000);
  }
  core::PerPlanarAxis<core::Nanoseconds> until{{100'000, 100'000}};
  core::PerPlanarAxis<std::uint32_t> sequence{{1, 1}};
  core::PerPlanarAxis<std::int64_t> ab_edges{};
  for (const auto& m : c.peer.all<EdgeInterval>()) {
    ASSERT_EQ(m.start_ns, until[m.axis]);
    ASSERT_EQ(m.sequence, sequence[m.axis]++);
    ReferenceDecoder& decoder = decoders[m.axis];
    ASSERT_EQ((m.start_levels & 1U) != 0, decoder.a());
    ASSERT_EQ((m.start_levels & 2U) != 0, decoder.b());
    core::Nanoseconds t = m.start_ns;
    for (const protocol::EncoderEdge edge : m.edges) {
      t += edge.step_ns();
      decoder.toggle(edge.line());
      ab_edges[m.axis] += edge.line() != protocol::EncoderLine::kIndex ? 1 : 0;
    }
    ASSERT_LT(t, m.end_ns);
    until[m.axis] = m.end_ns;
  }
  for (const Axis axis : core::kPlanarAxes) {
    EXPECT_EQ(decoders[axis].count(), c.peer.truth.back().axes[axis].count);
    EXPECT_EQ(ab_edges[axis], c.peer.truth.back().axes[axis].edges_total);
    EXPECT_GT(ab_edges[axis], 100);
    EXPECT_EQ(until[axis], c.plant.now_ns());
  }
}

TEST(PlantNodeExchange, SplitsAnExchangeWithMoreEdgesThanAMessageHolds) {
  auto c = greeted(rig_starting_at(0.5, 0.3));
  c.greet();
  c.enable();
  c.drive(Axis::kY, 400);
  c.run_for(100'000'000);
  c.peer.forget();
  c.advance_by(100'000'000);
  std::size_t y_messages = 0;
  core::Nanoseconds until = 100'000'000;
  for (const auto& m : c.peer.all<EdgeInterval>()) {
    if (m.axis != Axis::kY) {
      continue;
    }
    ++y_messages;
    EXPECT_EQ(m.start_ns, until);
    until = m.end_ns;
    core::Nanoseconds t = m.start_ns;
    for (const protocol::EncoderEdge edge : m.edges) {
      t += edge.step_ns();
    }
    EXPECT_LT(t, m.end_ns);
  }
  EXPECT_GT(y_messages, 2U);
  EXPECT_EQ(until, 200'000'000);
}

TEST(PlantNodeExchange, SendsTheDigestToAControllerThatAsksForItAlone) {
  auto edges = greeted(rig_starting_at(1.0, 0.3));
  auto digest = greeted(rig_starting_at(1.0, 0.3));
  edges.greet();
  protocol::Hello hello = ScriptedController::hello();
  hello.capabilities = protocol::kCapabilityDigest;
  digest.greet(hello);
  for (ScriptedController* c : {&edges, &digest}) {
    c->peer.forget();
    c->enable();
    c->drive(Axis::kY, -150);
    c->run_for(300'000'000);
  }
  EXPECT_TRUE(digest.peer.all<EdgeInterval>().empty());
  EXPECT_EQ(digest.peer.order().substr(0, 24), "ReportY ReportX Advanced");
  std::int64_t change = 0;
  core::Nanoseconds last_edge = 0;
  int pulses = 0;
  for (const auto& report : digest.peer.all<protocol::EncoderReport>()) {
    if (report.axis == Axis::kY) {
      change += report.count_change;
      last_edge = report.last_edge_ns;
      pulses += report.index_pulses;
      EXPECT_EQ(report.illegal_transitions, 0);
    }
  }
  core::Nanoseconds expected_last = 0;
  int expected_pulses = 0;
  for (const auto& m : edges.peer.all<EdgeInterval>()) {
    core::Nanoseconds t = m.start_ns;
    bool index = (m.start_levels & 4U) != 0;
    for (const protocol::EncoderEdge edge : m.edges) {
      t += edge.step_ns();
      if (edge.line() == protocol::EncoderLine::kIndex) {
        index = !index;
        expected_pulses += m.axis == Axis::kY && index ? 1 : 0;
      } else if (m.axis == Axis::kY) {
        expected_last = t;
      }
    }
  }
  const std::int64_t first = static_cast<std::int64_t>(std::floor(1.0 / 3.95199662 * 1'760'000));
  EXPECT_EQ(change, digest.peer.truth.back().axes[Axis::kY].count - first);
  EXPECT_EQ(last_edge, expected_last);
  EXPECT_EQ(pulses, expected_pulses);
  EXPECT_GT(pulses, 0);
}

TEST(PlantNodeExchange, HowTimeIsCutIntoExchangesChangesNoBit) {
  const auto run = [](core::Nanoseconds exchange_ns) {
    ScriptedController c(rig_starting_at(1.0, 0.3), {{.time_ns = 133'333'333,
                                                      .kind = ScheduledEventKind::kPushCarriage,
                                                      .axis = Axis::kY,
                                                      .value = 12.0}});
    c.greet();
    c.enable();
    for (int i = 0; i < 10; ++i) {
      c.drive(Axis::kY, i % 2 == 0 ? 230 : -310);
      c.drive(Axis::kX, i % 3 == 0 ? -120 : 90);
      c.run_for(30'000'000, exchange_ns);
    }
    return c.peer.truth.back();
  };
  const TruthRow coarse = run(30'000'000);
  for (const core::Nanoseconds exchange_ns : {100'000, 1'000'000, 5'000'000}) {
    const TruthRow fine = run(exchange_ns);
    for (const Axis axis : core::kPlanarAxes) {
      EXPECT_EQ(fine.axes[axis].motor_angle_rad, coarse.axes[axis].motor_angle_rad);
      EXPECT_EQ(fine.axes[axis].carriage_m, coarse.axes[axis].carriage_m);
      EXPECT_EQ(fine.axes[axis].current_A, coarse.axes[axis].current_A);
      EXPECT_EQ(fine.axes[axis].edges_total, coarse.axes[axis].edges_total);
    }
  }
}

TEST(PlantNodeExchange, NonsenseIsReportedAndChangesNothing) {
  auto c = greeted(rig_starting_at(1.0, 0.3));
  c.greet();
  c.run_for(2'000'000);
  c.peer.forget();
  c.plant.on(protocol::Advance{1'000'000});      // backwards
  c.plant.on(protocol::Advance{2'050'000});      // half a tick
  c.plant.on(protocol::Advance{9'000'000'000});  // too far ahead
  c.plant.on(protocol::PwmDuty{.enable = true, .channel_a_ticks = 1, .period_ticks = 0});
  c.plant.on(protocol::PwmDuty{.axis = static_cast<Axis>(7), .period_ticks = 1000});
  c.plant.on(protocol::PwmDuty{
      .enable = true, .channel_a_ticks = 5, .channel_b_ticks = 5, .period_ticks = 1000});
  std::vector<ErrorCode> codes;
  for (const auto& fault : c.peer.all<protocol::Fault>()) {
    codes.push_back(fault.code);
  }
  EXPECT_EQ(codes,
            (std::vector<ErrorCode>{ErrorCode::kTimeNotMonotonic, ErrorCode::kMessageBadField,
                                    ErrorCode::kMessageBadField, ErrorCode::kMessageBadField,
                                    ErrorCode::kMessageBadField, ErrorCode::kBothChannelsActive}));
  EXPECT_EQ(c.plant.now_ns(), 2'000'000);
  EXPECT_EQ(c.peer.all(PlantEventKind::kFault).size(), 6U);
}

TEST(PlantNodeExchange, ABabblingPeerGetsABoundedNumberOfAnswers) {
  auto c = greeted(rig_starting_at(1.0, 0.3));
  c.greet();
  c.peer.forget();
  for (int i = 0; i < 10'000; ++i) {
    c.plant.on(protocol::Advance{-1});
  }
  EXPECT_LE(c.peer.messages.size(), 16U);
  c.peer.forget();
  c.advance_by(1'000'000);
  EXPECT_EQ(c.peer.order(), "EdgesY EdgesX Advanced");
}

TEST(PlantNodeExchange, AdvancingByNothingIsAnsweredAndMakesNoRow) {
  auto c = greeted(rig_starting_at(1.0, 0.3));
  c.greet();
  c.peer.forget();
  c.advance_by(0);
  EXPECT_EQ(c.peer.order(), "Advanced");
  EXPECT_TRUE(c.peer.truth.empty());
}

}  // namespace
}  // namespace towbench::emulator
