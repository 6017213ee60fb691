#include "bbmc/host/quadrature_decoder.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::bbmc {
namespace {

using protocol::EncoderEdge;
using protocol::EncoderEdges;
using protocol::EncoderLine;

// Levels of A and B at a count, by the table of the encoder: A leads B upwards.
std::uint8_t levels_at(std::int64_t count) {
  constexpr std::array<std::uint8_t, 4> kTable{0b00, 0b01, 0b11, 0b10};
  return kTable[static_cast<std::size_t>(((count % 4) + 4) % 4)];
}

// Writes the edges of a list of (time, count) steps by comparing levels: knows no decoding rule.
class EdgeWriter {
 public:
  explicit EdgeWriter(std::int64_t count) : count_(count) {}

  EncoderEdges message(core::Nanoseconds start_ns, core::Nanoseconds end_ns,
                       const std::vector<std::pair<core::Nanoseconds, std::int64_t>>& steps) {
    EncoderEdges message;
    message.start_levels = levels_at(count_);
    message.start_ns = start_ns;
    message.end_ns = end_ns;
    message.sequence = sequence_++;
    core::Nanoseconds last_ns = start_ns;
    for (const auto& [time_ns, count] : steps) {
      const auto changed = static_cast<std::uint8_t>(levels_at(count_) ^ levels_at(count));
      for (const EncoderLine line : {EncoderLine::kA, EncoderLine::kB}) {
        if ((changed >> static_cast<unsigned>(line)) & 1U) {
          EXPECT_TRUE(message.edges.push_back(
              EncoderEdge(static_cast<std::uint32_t>(time_ns - last_ns), line)));
          last_ns = time_ns;
        }
      }
      count_ = count;
    }
    return message;
  }

 private:
  std::int64_t count_;
  std::uint32_t sequence_ = 0;
};

std::int32_t position(const QuadratureDecoder& decoder) {
  return static_cast<std::int32_t>(decoder.read().position);
}

TEST(QuadratureDecoder, CountsARandomWalkFromEveryStartingState) {
  for (std::int64_t start = -2; start < 2; ++start) {
    core::Random random(7);
    EdgeWriter writer(start);
    QuadratureDecoder decoder;
    std::int64_t count = start;
    core::Nanoseconds time_ns = 0;
    for (int message = 0; message < 50; ++message) {
      const core::Nanoseconds begin_ns = time_ns;
      std::vector<std::pair<core::Nanoseconds, std::int64_t>> steps;
      for (int i = 0; i < 200; ++i) {
        time_ns += 1'000 + static_cast<core::Nanoseconds>(random.uniform() * 20'000);
        count += random.uniform() < 0.6 ? 1 : -1;
        steps.emplace_back(time_ns, count);
      }
      time_ns += 500;
      ASSERT_TRUE(decoder.take(writer.message(begin_ns, time_ns, steps)));
      ASSERT_EQ(position(decoder), count - start);
    }
    EXPECT_EQ(decoder.edges_seen(), 50U * 200U);
    EXPECT_EQ(decoder.read().illegal_transitions, 0U);
  }
}

TEST(QuadratureDecoder, CapturesTheTicksOfAFreeRunningClockBetweenTheLastTwoEdges) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  // Edges at 100,000 and 125,600 ns: ticks 156 and 196 of the 640 ns clock.
  ASSERT_TRUE(decoder.take(writer.message(0, 200'000, {{100'000, 1}, {125'600, 2}})));
  const Eqep::Reading reading = decoder.read();
  EXPECT_TRUE(reading.capture_valid);
  EXPECT_EQ(reading.capture_ticks, 196U - 156U);
  EXPECT_EQ(reading.since_edge_ticks, 200'000U / 640U - 196U);
  EXPECT_TRUE(reading.forward);
  EXPECT_EQ(reading.time_ns, 200'000);
}

TEST(QuadratureDecoder, AReversalMakesTheCaptureInvalidUntilTwoEdgesAgree) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  ASSERT_TRUE(decoder.take(writer.message(0, 400'000, {{100'000, 1}, {200'000, 2}, {300'000, 1}})));
  EXPECT_FALSE(decoder.read().capture_valid);
  EXPECT_FALSE(decoder.read().forward);
  ASSERT_TRUE(decoder.take(writer.message(400'000, 500'000, {{450'000, 0}})));
  EXPECT_TRUE(decoder.read().capture_valid);
}

TEST(QuadratureDecoder, TheSixteenBitCaptureTimerSaturatesAndSaysSo) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  ASSERT_TRUE(
      decoder.take(writer.message(0, 100'000'000, {{1'000, 1}, {1'000 + 65'536 * 640, 2}})));
  EXPECT_EQ(decoder.read().capture_ticks, 65'535U);
  EXPECT_FALSE(decoder.read().capture_valid);
  EXPECT_EQ(decoder.read().since_edge_ticks, 65'535U);
}

TEST(QuadratureDecoder, BothChannelsAtOnceIsIllegalAndLeavesTheCount) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  // From count 2 to 4: A and B both change at 300,000 ns.
  ASSERT_TRUE(decoder.take(
      writer.message(0, 500'000, {{100'000, 1}, {200'000, 2}, {300'000, 4}, {400'000, 5}})));
  EXPECT_EQ(decoder.read().illegal_transitions, 1U);
  EXPECT_EQ(position(decoder), 3);  // the two lost counts stay lost, as in the peripheral
}

TEST(QuadratureDecoder, ADeadChannelMakesTheCountDitherNotRun) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  EncoderEdges message;
  message.end_ns = 1'000'000;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(message.edges.push_back(EncoderEdge(5'000, EncoderLine::kB)));
  }
  ASSERT_TRUE(decoder.take(message));
  EXPECT_LE(std::abs(position(decoder)), 1);
  EXPECT_EQ(decoder.read().edges, 100U);
}

TEST(QuadratureDecoder, LatchesTheCountAtTheIndexPulseInBothDirections) {
  QuadratureDecoder decoder;
  EncoderEdges message;
  message.end_ns = 1'000'000;
  for (const EncoderLine line : {EncoderLine::kA, EncoderLine::kB, EncoderLine::kIndex,
                                 EncoderLine::kA, EncoderLine::kIndex, EncoderLine::kB}) {
    ASSERT_TRUE(message.edges.push_back(EncoderEdge(1'000, line)));
  }
  ASSERT_TRUE(decoder.take(message));
  EXPECT_EQ(decoder.read().index_pulses, 1U);
  EXPECT_EQ(decoder.read().index_position, 2U);
}

TEST(QuadratureDecoder, ALineThatChangedBetweenMessagesIsDecodedAsTheHardwareWould) {
  QuadratureDecoder decoder;
  EncoderEdges first;
  first.end_ns = 1'000'000;
  ASSERT_TRUE(decoder.take(first));
  EncoderEdges second;
  second.start_levels = 0b01;  // A has risen unseen
  second.start_ns = 1'000'000;
  second.end_ns = 2'000'000;
  second.sequence = 1;
  ASSERT_TRUE(decoder.take(second));
  EXPECT_EQ(position(decoder), 1);
}

TEST(QuadratureDecoder, ReportsAMissingMessageByNumberAndByTime) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  ASSERT_TRUE(decoder.take(writer.message(0, 1'000'000, {})));
  EncoderEdges skipped = writer.message(1'000'000, 2'000'000, {});
  skipped.sequence += 1;
  EXPECT_FALSE(decoder.take(skipped));
  skipped.sequence += 1;
  skipped.start_ns = 3'000'000;
  EXPECT_FALSE(decoder.take(skipped));
}

TEST(QuadratureDecoder, AMessageThatComesAgainIsToldAndNotCountedTwice) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  ASSERT_TRUE(decoder.take(writer.message(0, 1'000'000, {{100, 1}, {200, 2}, {300, 3}})));
  const EncoderEdges again = writer.message(1'000'000, 2'000'000, {{1'000'100, 4}, {1'000'200, 5}});
  ASSERT_TRUE(decoder.take(again));
  ASSERT_EQ(position(decoder), 5);
  EXPECT_FALSE(decoder.take(again));
  EXPECT_EQ(position(decoder), 5);
  EXPECT_TRUE(decoder.take(writer.message(2'000'000, 3'000'000, {{2'000'100, 6}})));
  EXPECT_EQ(position(decoder), 6);
}

TEST(QuadratureDecoder, PositionWrapsAtItsMaximumAsQPosMaxDoes) {
  EdgeWriter writer(0);
  QuadratureDecoder decoder;
  ASSERT_TRUE(decoder.configure({.position_max = 9'999}));
  decoder.load_position(9'999);
  ASSERT_TRUE(decoder.take(writer.message(0, 1'000'000, {{100, 1}, {1'000, 2}})));
  EXPECT_EQ(decoder.read().position, 1U);
  ASSERT_TRUE(decoder.take(
      writer.message(1'000'000, 2'000'000, {{1'100'000, 1}, {1'200'000, 0}, {1'300'000, -1}})));
  EXPECT_EQ(decoder.read().position, 9'998U);
}

TEST(QuadratureDecoder, ADigestGivesTheSamePositionAndPeriodAsTheEdges) {
  EdgeWriter writer(0);
  QuadratureDecoder from_edges;
  QuadratureDecoder from_digest;
  ASSERT_TRUE(from_edges.take(writer.message(0, 200'000, {{100'000, 1}, {125'600, 2}})));
  ASSERT_TRUE(from_digest.take(protocol::EncoderReport{.time_ns = 200'000,
                                                       .count_change = 2,
                                                       .last_edge_ns = 125'600,
                                                       .capture_period_ns = 25'600}));
  EXPECT_EQ(from_digest.read().position, from_edges.read().position);
  EXPECT_EQ(from_digest.read().capture_ticks, from_edges.read().capture_ticks);
  EXPECT_EQ(from_digest.read().since_edge_ticks, from_edges.read().since_edge_ticks);
  EXPECT_EQ(from_digest.read().capture_valid, from_edges.read().capture_valid);
  EXPECT_FALSE(from_digest.read().edges_known);
}

}  // namespace
}  // namespace towbench::bbmc
