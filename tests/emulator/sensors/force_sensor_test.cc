#include "emulator/sensors/force_sensor.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/time.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr ForceSensorParameters kQuiet{.fitted = true,
                                       .load_mass_kg = 0.4,
                                       .lever_m = 0.3,
                                       .bandwidth_Hz = 200.0,
                                       .force_noise_rms_N = 0.0,
                                       .torque_noise_rms_Nm = 0.0,
                                       .force_bias_deviation_N = 0.0,
                                       .torque_bias_deviation_Nm = 0.0,
                                       .sample_period_s = 1e-4};

core::PerPlanarAxis<double> plane(double x, double y) {
  core::PerPlanarAxis<double> v;
  v[Axis::kX] = x;
  v[Axis::kY] = y;
  return v;
}

using Channels = std::array<double, 6>;

// Samples at every tick of a constant load.
std::vector<Channels> samples_of(const ForceSensorParameters& parameters, std::uint64_t seed,
                                 const core::PerPlanarAxis<double>& load_N,
                                 const core::PerPlanarAxis<double>& acceleration, int ticks) {
  ForceSensor sensor(parameters, seed);
  std::vector<Channels> samples;
  protocol::ForceSample sample;
  for (int tick = 1; tick <= ticks; ++tick) {
    EXPECT_TRUE(sensor.step(tick * core::kPlantTick_ns, load_N, acceleration, sample));
    EXPECT_EQ(sample.time_ns, tick * core::kPlantTick_ns);
    Channels channels{};
    for (std::size_t i = 0; i < 3; ++i) {
      channels[i] = static_cast<double>(sample.force_N[i]);
      channels[i + 3] = static_cast<double>(sample.torque_Nm[i]);
    }
    samples.push_back(channels);
  }
  return samples;
}

// F = F_load - m a and T = r x F with r = (0, 0, -0.3), by the determinant.
TEST(ForceSensor, ShowsTheLoadLessItsInertiaAndTheMomentAtTheMount) {
  const auto last = samples_of(kQuiet, 1, plane(1.5, -2.0), plane(0.5, -1.0), 1000).back();
  const double x = 1.5 - 0.4 * 0.5;
  const double y = -2.0 + 0.4 * 1.0;
  const double rz = -0.3;
  const Channels expected{x, y, 0.0, 0.0 * 0.0 - rz * y, rz * x - 0.0 * 0.0, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(last[i], expected[i], 1e-6) << i;
  }
}

TEST(ForceSensor, AnswersAStepOfForceWithTheExponentialOfItsBandwidth) {
  const auto samples = samples_of(kQuiet, 1, plane(0.0, 3.0), plane(0.0, 0.0), 100);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i + 1) * core::kPlantTick_s;
    ASSERT_NEAR(samples[i][1], 3.0 * (1.0 - std::exp(-2.0 * std::numbers::pi * 200.0 * t)), 1e-6);
  }
}

ForceSensorParameters noisy() {
  ForceSensorParameters p = kQuiet;
  p.force_noise_rms_N = 0.02;
  p.torque_noise_rms_Nm = 0.001;
  p.force_bias_deviation_N = 0.05;
  p.torque_bias_deviation_Nm = 0.002;
  return p;
}

TEST(ForceSensor, HasIndependentNoiseOfItsSizeOnEachOfItsSixChannels) {
  constexpr int kSamples = 20'000;
  const auto samples = samples_of(noisy(), 9, plane(0.0, 0.0), plane(0.0, 0.0), kSamples);
  Channels mean{};
  for (const Channels& s : samples) {
    for (std::size_t i = 0; i < 6; ++i) {
      mean[i] += s[i] / kSamples;
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double product = 0.0;
      for (const Channels& s : samples) {
        product += (s[i] - mean[i]) * (s[j] - mean[j]) / kSamples;
      }
      const double size = (i < 3 ? 0.02 : 0.001) * (j < 3 ? 0.02 : 0.001);
      EXPECT_NEAR(product, i == j ? size : 0.0, size * 5.0 * std::sqrt(2.0 / kSamples))
          << i << " " << j;
    }
  }
}

TEST(ForceSensor, DrawsABiasForEachChannelFromTheSeed) {
  constexpr int kSeeds = 2000;
  ForceSensorParameters p = noisy();
  p.force_noise_rms_N = 0.0;
  p.torque_noise_rms_Nm = 0.0;
  Channels squares{};
  for (int i = 0; i < kSeeds; ++i) {
    // Far apart, as a rig's stream of seeds is.
    const auto seed = static_cast<std::uint64_t>(i) * 1'000'003U;
    const Channels bias = samples_of(p, seed, plane(0.0, 0.0), plane(0.0, 0.0), 1).back();
    for (std::size_t c = 0; c < 6; ++c) {
      squares[c] += bias[c] * bias[c] / kSeeds;
    }
  }
  for (std::size_t c = 0; c < 6; ++c) {
    const double size = c < 3 ? 0.05 : 0.002;
    EXPECT_NEAR(std::sqrt(squares[c]), size, size * 4.0 / std::sqrt(2.0 * kSeeds)) << c;
  }
}

}  // namespace
}  // namespace towbench::emulator
