#include "emulator/sensors/encoder_wiring.h"

#include <vector>

#include <gtest/gtest.h>

#include "emulator/sensors/encoder_digest.h"
#include "emulator/sensors/quadrature_encoder.h"
#include "tests/emulator/sensors/motion_under_test.h"
#include "tests/emulator/sensors/reference_decoder.h"

namespace towbench::emulator {
namespace {

using protocol::EncoderLine;

// Ten counts a step upwards from 0.5, steadily.
class SteadyEncoder {
 public:
  SteadyEncoder() : encoder({.index_count = 25}, 0.5 / kCountsPerRad), wiring(encoder.levels()) {}

  const StepEdges& step() {
    const double to = at_ + 10.0;
    MotionSegments segments;
    const double rate = 10.0 / core::kPlantTick_s / kCountsPerRad;
    core::check(segments.push_back(
        {0.0, core::kPlantTick_s, at_ / kCountsPerRad, rate, to / kCountsPerRad, rate}));
    at_ = to;
    encoder.step(segments, edges_);
    made.assign(edges_.view().begin(), edges_.view().end());
    wiring.step(encoder.levels(), edges_);
    return edges_;
  }

  QuadratureEncoder encoder;
  EncoderWiring wiring;
  std::vector<TimedEdge> made;

 private:
  StepEdges edges_;
  double at_ = 0.5;
};

std::vector<std::uint32_t> packed(std::span<const TimedEdge> edges) {
  std::vector<std::uint32_t> words;
  for (const TimedEdge edge : edges) {
    words.push_back(edge.packed());
  }
  return words;
}

TEST(EncoderWiring, PassesEveryEdgeUntouchedWhileIntact) {
  SteadyEncoder s;
  for (int i = 0; i < 20; ++i) {
    const StepEdges& arrived = s.step();
    EXPECT_EQ(packed(arrived.view()), packed(s.made));
  }
  EXPECT_EQ(s.wiring.surplus_edges(), 0);
}

TEST(EncoderWiring, ADeadChannelIsSilentFromItsTimeOnAndTheOtherGoesOn) {
  SteadyEncoder s;
  s.step();
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kA, WireCondition::kStuckLow, 50'000));
  std::size_t a_edges = 0;
  std::size_t b_edges = 0;
  for (int i = 0; i < 10; ++i) {
    for (const TimedEdge edge : s.step().view()) {
      if (edge.line() == EncoderLine::kA) {
        ++a_edges;
        EXPECT_TRUE(i == 0 && edge.time_ns() <= 50'000);
      }
      b_edges += edge.line() == EncoderLine::kB ? 1U : 0U;
    }
  }
  EXPECT_LE(a_edges, 4U);
  EXPECT_EQ(b_edges, 50U);
  EXPECT_LT(s.wiring.surplus_edges(), -40);
}

TEST(EncoderWiring, AWireThatBreaksWhileHighFallsOnceAtThatTime) {
  SteadyEncoder s;
  s.step();  // ends at 10.5: count 10, A and B high
  ASSERT_EQ(s.encoder.levels() & 3U, 3U);
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kA, WireCondition::kStuckLow, 1'234));
  const TimedEdge first = s.step()[0];
  EXPECT_EQ(first.time_ns(), 1'234);
  EXPECT_EQ(first.line(), EncoderLine::kA);
}

TEST(EncoderWiring, SwappedChannelsAndOneInvertedChannelCountBackwards) {
  for (const bool swap : {true, false}) {
    SteadyEncoder s;
    ReferenceDecoder decoder(s.encoder.levels(), 0);
    ASSERT_TRUE(swap ? s.wiring.swap_channels(true, 0)
                     : s.wiring.set_line(EncoderLine::kB, WireCondition::kInverted, 0));
    std::int64_t first = 0;
    for (int i = 0; i < 40; ++i) {
      for (const TimedEdge edge : s.step().view()) {
        decoder.toggle(edge.line());
      }
      first = i == 0 ? decoder.count() : first;
    }
    EXPECT_EQ(decoder.count() - first, -390);
  }
}

TEST(EncoderWiring, HealsIntoTheEncodersOwnLevelsAndCostsNothingAgain) {
  SteadyEncoder s;
  ReferenceDecoder decoder(s.encoder.levels(), 0);
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kA, WireCondition::kStuckHigh, 10));
  for (int i = 0; i < 5; ++i) {
    for (const TimedEdge edge : s.step().view()) {
      decoder.toggle(edge.line());
    }
  }
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kA, WireCondition::kIntact, 99'000));
  for (const TimedEdge edge : s.step().view()) {
    decoder.toggle(edge.line());
  }
  EXPECT_EQ(decoder.a(), (s.encoder.levels() & 1U) != 0);
  EXPECT_EQ(decoder.b(), (s.encoder.levels() & 2U) != 0);
  const std::int64_t surplus = s.wiring.surplus_edges();
  EXPECT_EQ(packed(s.step().view()), packed(s.made));
  EXPECT_EQ(s.wiring.surplus_edges(), surplus);
}

TEST(EncoderWiring, AMissingIndexIsMissing) {
  SteadyEncoder s;
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kIndex, WireCondition::kStuckLow, 0));
  for (int i = 0; i < 10; ++i) {
    for (const TimedEdge edge : s.step().view()) {
      EXPECT_NE(edge.line(), EncoderLine::kIndex);
    }
  }
}

TEST(EncoderWiring, BothChannelsAtOnceAreAnIllegalTransitionToADecoder) {
  SteadyEncoder s;
  EncoderDigest digest(core::Axis::kY, s.encoder.levels());
  digest.add(0, s.step());
  EXPECT_EQ(digest.take(100'000).count_change, 10);
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kA, WireCondition::kStuckLow, 100));
  ASSERT_TRUE(s.wiring.set_line(EncoderLine::kB, WireCondition::kStuckLow, 100));
  digest.add(100'000, s.step());
  const auto broken = digest.take(200'000);
  EXPECT_EQ(broken.illegal_transitions, 1);
  EXPECT_EQ(broken.levels & 3U, 0);
  EXPECT_EQ(broken.count_change, 0);
}

TEST(EncoderWiring, RefusesMoreChangesThanOneStepHasRoomFor) {
  SteadyEncoder s;
  int taken = 0;
  while (s.wiring.swap_channels(taken % 2 == 0, 5)) {
    ++taken;
  }
  EXPECT_EQ(taken, 8);
  s.step();
  EXPECT_TRUE(s.wiring.swap_channels(true, 5));
}

}  // namespace
}  // namespace towbench::emulator
