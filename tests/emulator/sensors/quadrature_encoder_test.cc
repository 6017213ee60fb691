#include "emulator/sensors/quadrature_encoder.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/emulator/sensors/motion_under_test.h"
#include "tests/emulator/sensors/reference_decoder.h"

namespace towbench::emulator {
namespace {

using protocol::EncoderLine;

// Error of the motion's cubic between its 100 us points, and of doubles at 1e5 counts.
constexpr double kMotionError_counts = 3e-5;
constexpr double kRounding_ns = 0.6;

struct MotionCase {
  std::uint64_t seed;
  double drift_counts_per_s;
  double sway_counts;
};

class QuadratureEncoderFollowing : public testing::TestWithParam<MotionCase> {};

// At every edge the decoded count is the floor of the true angle just after it, and the edge lies
// where the angle passes the count's threshold, to the nanosecond that the motion's speed allows.
TEST_P(QuadratureEncoderFollowing, PutsEveryEdgeWhereTheTrueAngleCrossesItsCount) {
  const MotionCase& c = GetParam();
  const SmoothMotion motion(c.seed, c.drift_counts_per_s, c.sway_counts);
  QuadratureEncoder encoder({}, motion.counts(0.0) / kCountsPerRad);
  ReferenceDecoder decoder(encoder.levels(), encoder.count());
  ASSERT_EQ(decoder.count(), static_cast<std::int64_t>(std::floor(motion.counts(0.0))));
  StepEdges edges;
  for (int step = 0; step < 3000; ++step) {
    encoder.step(segments_of(motion, step, 1 + step % 4), edges);
    std::int32_t last_ns = 0;
    for (const TimedEdge edge : edges.view()) {
      ASSERT_GE(edge.time_ns(), last_ns);
      ASSERT_LT(edge.time_ns(), core::kPlantTick_ns);
      last_ns = edge.time_ns();
      const std::int64_t before = decoder.count();
      decoder.toggle(edge.line());
      if (edge.line() == EncoderLine::kIndex) {
        continue;
      }
      ASSERT_EQ(std::abs(decoder.count() - before), 1);
      const double t = step * core::kPlantTick_s + edge.time_ns() * 1e-9;
      const auto threshold = static_cast<double>(std::max(before, decoder.count()));
      const double slack =
          kMotionError_counts + std::fabs(motion.counts_per_s(t)) * kRounding_ns * 1e-9;
      ASSERT_NEAR(motion.counts(t), threshold, slack) << "step " << step;
    }
    const double end = motion.counts((step + 1) * core::kPlantTick_s);
    if (std::fabs(end - std::round(end)) > kMotionError_counts) {
      ASSERT_EQ(decoder.count(), static_cast<std::int64_t>(std::floor(end))) << "step " << step;
    }
    ASSERT_EQ(decoder.count(), encoder.count());
  }
}

// Nothing is missed between the edges either: a short visit to the next count is two edges.
TEST_P(QuadratureEncoderFollowing, AgreesWithTheTrueAngleAtEveryDenseSample) {
  const MotionCase& c = GetParam();
  const SmoothMotion motion(c.seed, c.drift_counts_per_s, c.sway_counts);
  QuadratureEncoder encoder({}, motion.counts(0.0) / kCountsPerRad);
  ReferenceDecoder decoder(encoder.levels(), encoder.count());
  StepEdges edges;
  for (int step = 0; step < 300; ++step) {
    encoder.step(segments_of(motion, step, 1 + step % 3), edges);
    std::size_t next = 0;
    for (int sample_ns = 0; sample_ns < core::kPlantTick_ns; sample_ns += 53) {
      for (; next < edges.size() && edges[next].time_ns() <= sample_ns; ++next) {
        decoder.toggle(edges[next].line());
      }
      const double t = step * core::kPlantTick_s + sample_ns * 1e-9;
      const double counts = motion.counts(t);
      const double unsure =
          kMotionError_counts + std::fabs(motion.counts_per_s(t)) * kRounding_ns * 1e-9;
      if (std::fabs(counts - std::round(counts)) > unsure) {
        ASSERT_EQ(decoder.count(), static_cast<std::int64_t>(std::floor(counts)))
            << "step " << step << " at " << sample_ns << " ns";
      }
    }
    for (; next < edges.size(); ++next) {
      decoder.toggle(edges[next].line());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, QuadratureEncoderFollowing,
                         testing::Values(MotionCase{1, 250e3, 40.0}, MotionCase{2, 250e3, 4.0},
                                         MotionCase{3, 700e3, 40.0}, MotionCase{4, 20e3, 40.0},
                                         MotionCase{5, 1e3, 40.0}, MotionCase{6, 10.0, 40.0},
                                         MotionCase{7, 0.0, 40.0}, MotionCase{8, 0.0, 4.0},
                                         MotionCase{9, 100.0, 0.5}, MotionCase{10, 5e3, 0.0},
                                         MotionCase{11, 0.0, 400.0}, MotionCase{12, 50e3, 400.0}));

MotionSegment hermite(double from_s, double to_s, double start, double rate_start, double end,
                      double rate_end) {
  return {.start_s = from_s,
          .end_s = to_s,
          .start_angle_rad = start / kCountsPerRad,
          .start_speed_rad_per_s = rate_start / kCountsPerRad,
          .end_angle_rad = end / kCountsPerRad,
          .end_speed_rad_per_s = rate_end / kCountsPerRad};
}

TEST(QuadratureEncoder, MakesTheTwoEdgesOfAnExcursionInsideOneStep) {
  // x(t) = 0.9 + 4 (0.25 - (u - 0.5)^2) * 0.4: peaks at 1.3 in mid step, passes 1 twice.
  const double rate = 1.6 / core::kPlantTick_s;
  MotionSegments segments;
  ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, 0.9, rate, 0.9, -rate)));
  QuadratureEncoder encoder({.index_count = 2000}, 0.9 / kCountsPerRad);
  StepEdges edges;
  encoder.step(segments, edges);
  ASSERT_EQ(edges.size(), 2U);
  // 1.6 u (1 - u) = 0.1.
  const double u = 0.5 - std::sqrt(0.25 - 0.1 / 1.6);
  EXPECT_NEAR(edges[0].time_ns(), u * 1e5, 1.0);
  EXPECT_NEAR(edges[1].time_ns(), (1.0 - u) * 1e5, 1.0);
  EXPECT_EQ(edges[0].line(), EncoderLine::kA);
  EXPECT_EQ(edges[1].line(), EncoderLine::kA);
  EXPECT_EQ(encoder.count(), 0);
}

// A count whose angle in rad comes back as exactly that count.
double exactly_representable_count() {
  double count = 10.0;
  while ((count / kCountsPerRad) * kCountsPerRad != count) {
    count += 1.0;
  }
  return count;
}

TEST(QuadratureEncoder, CountsAThresholdTouchedAtTheEndOfAStepOnce) {
  const double touched = exactly_representable_count();
  QuadratureEncoder encoder({.index_count = 2000}, (touched - 0.5) / kCountsPerRad);
  StepEdges edges;
  std::size_t total = 0;
  const double rate = 0.5 / core::kPlantTick_s;
  const auto run = [&](double from, double from_rate, double to, double to_rate) {
    MotionSegments segments;
    ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, from, from_rate, to, to_rate)));
    encoder.step(segments, edges);
    total += edges.size();
  };
  run(touched - 0.5, rate, touched, rate);
  run(touched, rate, touched + 0.5, rate);
  run(touched + 0.5, -rate, touched, -rate);
  EXPECT_EQ(total, 1U);
  EXPECT_EQ(encoder.count(), static_cast<std::int64_t>(touched));
  // Standing exactly there makes nothing more; leaving downwards makes one.
  for (int i = 0; i < 100; ++i) {
    run(touched, 0.0, touched, 0.0);
  }
  EXPECT_EQ(total, 1U);
  run(touched, -rate, touched - 0.5, -rate);
  EXPECT_EQ(total, 2U);
}

TEST(QuadratureEncoder, IsSilentAtRest) {
  QuadratureEncoder encoder({}, 123.456 / kCountsPerRad);
  MotionSegments segments;
  ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, 123.456, 0, 123.456, 0)));
  StepEdges edges;
  for (int i = 0; i < 10; ++i) {
    encoder.step(segments, edges);
    EXPECT_TRUE(edges.empty());
  }
}

TEST(QuadratureEncoder, RaisesTheIndexForOneCountATurnInBothDirections) {
  constexpr std::int64_t kIndex = 1234;
  for (const double sign : {1.0, -1.0}) {
    QuadratureEncoder encoder({.index_count = kIndex}, sign * 100.5 / kCountsPerRad);
    ReferenceDecoder decoder(encoder.levels(), encoder.count());
    StepEdges edges;
    int pulses = 0;
    const double rate = sign * 100e3;
    for (int step = 0; step < 2000; ++step) {  // 20,000 counts: five turns
      const double from = sign * 100.5 + rate * step * core::kPlantTick_s;
      const double to = sign * 100.5 + rate * (step + 1) * core::kPlantTick_s;
      MotionSegments segments;
      ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, from, rate, to, rate)));
      encoder.step(segments, edges);
      for (const TimedEdge edge : edges.view()) {
        const bool was_high = decoder.index();
        if (edge.line() != EncoderLine::kIndex) {
          // Between two counts the index belongs to the count that is left now: one count wide.
          ASSERT_EQ(was_high, ((decoder.count() % 4000) + 4000) % 4000 == kIndex);
        }
        decoder.toggle(edge.line());
        pulses += !was_high && decoder.index() ? 1 : 0;
        if (edge.line() == EncoderLine::kIndex && decoder.index()) {
          ASSERT_EQ(((decoder.count() % 4000) + 4000) % 4000, kIndex);
        }
      }
      const bool expected = ((encoder.count() % 4000) + 4000) % 4000 == kIndex;
      ASSERT_EQ(decoder.index(), expected);
    }
    EXPECT_EQ(pulses, 5);
  }
}

// Over the whole turn, in both directions: the same count, and the third line never moves.
TEST(QuadratureEncoder, WithoutAnIndexCountsTheSame) {
  for (const double sign : {1.0, -1.0}) {
    QuadratureEncoder with({.index_count = 1234}, sign * 100.5 / kCountsPerRad);
    QuadratureEncoder without({.index_count = -1}, sign * 100.5 / kCountsPerRad);
    StepEdges edges;
    const double rate = sign * 100e3;
    for (int step = 0; step < 1000; ++step) {
      const double from = sign * 100.5 + rate * step * core::kPlantTick_s;
      const double to = sign * 100.5 + rate * (step + 1) * core::kPlantTick_s;
      MotionSegments segments;
      ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, from, rate, to, rate)));
      with.step(segments, edges);
      without.step(segments, edges);
      ASSERT_EQ(without.count(), with.count());
      ASSERT_EQ(without.levels(), with.levels() & 3U);
      for (const TimedEdge edge : edges.view()) {
        ASSERT_NE(edge.line(), EncoderLine::kIndex);
      }
    }
  }
}

TEST(QuadratureEncoder, FlagsMotionFasterThanItsChannelsCarry) {
  // 200 kHz a channel is 800,000 counts/s.
  for (const auto& [rate, too_fast] : {std::pair{799e3, false}, std::pair{801e3, true}}) {
    QuadratureEncoder encoder({}, 0.0);
    MotionSegments segments;
    const double end = rate * core::kPlantTick_s;
    ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, 0, rate, end, rate)));
    StepEdges edges;
    encoder.step(segments, edges);
    EXPECT_EQ(encoder.too_fast(), too_fast) << rate;
  }
}

TEST(QuadratureEncoder, LosesNoEdgeWhenAStepHasMoreThanFit) {
  // 3000 counts in one step, then rest, motion on, or motion back.
  for (const double later_rate : {0.0, 50e3, -50e3}) {
    QuadratureEncoder encoder({}, 0.5 / kCountsPerRad);
    ReferenceDecoder decoder(encoder.levels(), encoder.count());
    StepEdges edges;
    double at = 0.5;
    for (int step = 0; step < 10; ++step) {
      const double rate = step == 0 ? 3000.0 / core::kPlantTick_s : later_rate;
      const double to = at + rate * core::kPlantTick_s;
      MotionSegments segments;
      ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, at, rate, to, rate)));
      encoder.step(segments, edges);
      std::int32_t last_ns = 0;
      for (const TimedEdge edge : edges.view()) {
        ASSERT_GE(edge.time_ns(), last_ns);
        last_ns = edge.time_ns();
        decoder.toggle(edge.line());
      }
      EXPECT_EQ(encoder.too_fast(), step <= 1) << step;
      at = to;
    }
    EXPECT_EQ(decoder.count(), static_cast<std::int64_t>(std::floor(at)));
  }
}

// One step of a cubic motion in closed form, in counts and seconds.
struct Cubic {
  double start;
  double rate;
  double acceleration;
  double jerk;
  [[nodiscard]] double at(double t) const {
    return start + t * (rate + t * (acceleration / 2.0 + t * jerk / 6.0));
  }
  [[nodiscard]] double rate_at(double t) const {
    return rate + t * (acceleration + t * jerk / 2.0);
  }
};

// Ten times harder than the drive can shake the shaft (3.7e6 counts/s2), at all speeds: edges stay
// within 1.5 ns of the closed form or, where the shaft hardly moves, within 1e-8 counts of it.
TEST(QuadratureEncoder, KeepsItsTimesUnderTheHardestAcceleration) {
  core::Random random(5);
  for (int round = 0; round < 20'000; ++round) {
    const double hardness = 37e6 * random.uniform();
    const Cubic motion{.start = 1e4 * (random.uniform() - 0.5),
                       .rate = 300e3 * (random.uniform() - 0.5) * random.uniform(),
                       .acceleration = hardness * (2.0 * random.uniform() - 1.0),
                       .jerk = hardness * 2e4 * (2.0 * random.uniform() - 1.0)};
    MotionSegments segments;
    ASSERT_TRUE(segments.push_back(hermite(0, core::kPlantTick_s, motion.start, motion.rate,
                                           motion.at(core::kPlantTick_s),
                                           motion.rate_at(core::kPlantTick_s))));
    QuadratureEncoder encoder({}, motion.start / kCountsPerRad);
    ReferenceDecoder decoder(encoder.levels(), encoder.count());
    StepEdges edges;
    encoder.step(segments, edges);
    for (const TimedEdge edge : edges.view()) {
      const std::int64_t before = decoder.count();
      decoder.toggle(edge.line());
      if (edge.line() == EncoderLine::kIndex) {
        continue;
      }
      const double t = edge.time_ns() * 1e-9;
      const auto threshold = static_cast<double>(std::max(before, decoder.count()));
      const double slope =
          std::max(std::fabs(motion.rate_at(t - 1e-9)), std::fabs(motion.rate_at(t + 1e-9)));
      ASSERT_NEAR(motion.at(t), threshold, 1e-8 + 1.5e-9 * slope) << "round " << round;
    }
    ASSERT_EQ(decoder.count(),
              static_cast<std::int64_t>(std::floor(motion.at(core::kPlantTick_s))));
  }
}

}  // namespace
}  // namespace towbench::emulator
