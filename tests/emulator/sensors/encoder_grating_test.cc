#include "emulator/sensors/encoder_grating.h"

#include <cmath>

#include <gtest/gtest.h>

#include "emulator/sensors/quadrature_encoder.h"
#include "tests/emulator/sensors/motion_under_test.h"
#include "tests/emulator/sensors/reference_decoder.h"

namespace towbench::emulator {
namespace {

// The lines of an imperfect encoder written down from the definition: a reading with a once-a-turn
// error, channel A high for `width` from one count into each period on, B the same `phase` later.
struct LinesFromDefinition {
  EncoderParameters p;

  [[nodiscard]] double reading(double counts) const {
    const double turns = counts / 4000.0 - p.eccentricity_phase_deg / 360.0;
    return counts + p.eccentricity_counts * std::sin(2.0 * std::numbers::pi * turns);
  }
  [[nodiscard]] static bool high(double reading, double rise, double width) {
    const double in_period = (reading - rise) - 4.0 * std::floor((reading - rise) / 4.0);
    return in_period < width;
  }
  [[nodiscard]] bool a(double counts) const {
    return high(reading(counts), 1.0, p.pulse_width_deg / 90.0);
  }
  [[nodiscard]] bool b(double counts) const {
    return high(reading(counts), 1.0 + p.phase_deg / 90.0, p.pulse_width_deg / 90.0);
  }
  // Near an edge either level is right.
  [[nodiscard]] bool clear(double counts, double slack) const {
    return a(counts - slack) == a(counts + slack) && b(counts - slack) == b(counts + slack);
  }
};

class ImperfectEncoder : public testing::TestWithParam<EncoderParameters> {};

TEST_P(ImperfectEncoder, HasTheLevelsOfItsDefinitionAtEverySample) {
  const LinesFromDefinition truth{GetParam()};
  for (const double drift : {250e3, 0.0}) {
    const SmoothMotion motion(77, drift, 200.0);
    QuadratureEncoder encoder(GetParam(), motion.counts(0.0) / kCountsPerRad);
    ReferenceDecoder decoder(encoder.levels(), encoder.count());
    StepEdges edges;
    for (int step = 0; step < 400; ++step) {
      encoder.step(segments_of(motion, step, 1 + step % 3), edges);
      std::size_t next = 0;
      for (int sample_ns = 0; sample_ns < core::kPlantTick_ns; sample_ns += 211) {
        for (; next < edges.size() && edges[next].time_ns() <= sample_ns; ++next) {
          decoder.toggle(edges[next].line());
        }
        const double t = step * core::kPlantTick_s + sample_ns * 1e-9;
        const double counts = motion.counts(t);
        const double slack = 5e-5 + std::fabs(motion.counts_per_s(t)) * 1e-9;
        if (truth.clear(counts, slack)) {
          ASSERT_EQ(decoder.a(), truth.a(counts)) << step << " " << sample_ns;
          ASSERT_EQ(decoder.b(), truth.b(counts)) << step << " " << sample_ns;
        }
      }
      for (; next < edges.size(); ++next) {
        decoder.toggle(edges[next].line());
      }
      ASSERT_EQ(decoder.count(), encoder.count());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Gratings, ImperfectEncoder,
    testing::Values(EncoderParameters{}, EncoderParameters{.phase_deg = 45.0},
                    EncoderParameters{.phase_deg = 135.0},
                    EncoderParameters{.phase_deg = 70.0, .pulse_width_deg = 200.0},
                    EncoderParameters{.eccentricity_counts = 3.0, .eccentricity_phase_deg = 40.0},
                    EncoderParameters{.phase_deg = 120.0,
                                      .pulse_width_deg = 165.0,
                                      .eccentricity_counts = 40.0,
                                      .eccentricity_phase_deg = -200.0}));

TEST(EncoderGrating, AscendsThroughTheWholeTurnAndAcrossItsEnd) {
  const EncoderGrating grating(
      {.phase_deg = 135.0, .pulse_width_deg = 195.0, .eccentricity_counts = 50.0});
  for (std::int64_t n = -4010; n < 4010; ++n) {
    ASSERT_LT(grating.threshold(n, grating.in_turn(n)),
              grating.threshold(n + 1, grating.in_turn(n + 1)))
        << n;
  }
}

TEST(EncoderGrating, FindsTheCountThatEnclosesAnAngle) {
  const EncoderGrating grating({.phase_deg = 60.0, .eccentricity_counts = 20.0});
  for (double angle = -5000.0; angle < 5000.0; angle += 0.37) {
    const std::int64_t n = grating.count_at(angle);
    ASSERT_LE(grating.threshold(n, grating.in_turn(n)), angle);
    ASSERT_GT(grating.threshold(n + 1, grating.in_turn(n + 1)), angle);
  }
}

}  // namespace
}  // namespace towbench::emulator
