#include "emulator/sensors/analog_channel.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/time.h"

namespace towbench::emulator {
namespace {

TEST(AnalogChannel, AnswersAStepWithTheExponentialOfItsBandwidth) {
  constexpr double kBandwidth_Hz = 200.0;
  AnalogChannel channel(kBandwidth_Hz, 0.0, 0.0, 1);
  for (int step = 1; step <= 200; ++step) {
    channel.step(3.0);
    const double t = step * core::kPlantTick_s;
    const double expected = 3.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * kBandwidth_Hz * t));
    ASSERT_NEAR(channel.sample(), expected, 1e-12);
  }
}

TEST(AnalogChannel, HasTheNoiseAndOneBiasThatItsParametersSay) {
  constexpr int kSamples = 20'000;
  AnalogChannel channel(1000.0, 0.5, 0.1, 7);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    channel.step(0.0);
    const double sample = channel.sample();
    sum += sample;
    squares += sample * sample;
  }
  const double mean = sum / kSamples;
  const double deviation = std::sqrt(squares / kSamples - mean * mean);
  EXPECT_NEAR(deviation, 0.1, 0.1 * 4.0 / std::sqrt(2.0 * kSamples));
  EXPECT_NE(mean, 0.0);
  EXPECT_LT(std::fabs(mean), 6 * 0.5);
}

TEST(AnalogChannel, DrawsItsBiasWithTheDeviationGiven) {
  constexpr int kSeeds = 5000;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const double bias = AnalogChannel(1000.0, 0.5, 0.0, seed).sample();
    squares += bias * bias;
  }
  EXPECT_NEAR(std::sqrt(squares / kSeeds), 0.5, 0.5 * 4.0 / std::sqrt(2.0 * kSeeds));
}

TEST(AnalogChannel, RepeatsItselfForTheSameSeedOnly) {
  AnalogChannel first(1000.0, 0.5, 0.1, 7);
  AnalogChannel same(1000.0, 0.5, 0.1, 7);
  AnalogChannel other(1000.0, 0.5, 0.1, 8);
  for (int i = 0; i < 10; ++i) {
    const double sample = first.sample();
    EXPECT_EQ(sample, same.sample());
    EXPECT_NE(sample, other.sample());
  }
}

}  // namespace
}  // namespace towbench::emulator
