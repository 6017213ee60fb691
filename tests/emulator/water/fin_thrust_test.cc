#include "emulator/water/fin_thrust.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr FinParameters kFin{.fitted = true,
                             .mean_thrust_N = 0.25,
                             .thrust_amplitude_N = 0.4,
                             .side_amplitude_N = 0.7,
                             .thrust_frequency_Hz = 3.7,
                             .phase_deg = 25.0,
                             .start_s = 1.0,
                             .duration_s = 20.0};

// Impulse from the start of the profile to s, by the integral of its formula.
double forward_impulse(double s) {
  const double w = kTwoPi * kFin.thrust_frequency_Hz;
  const double phase = kFin.phase_deg * std::numbers::pi / 180.0;
  return kFin.mean_thrust_N * s +
         kFin.thrust_amplitude_N / w * (std::cos(phase) - std::cos(w * s + phase));
}

TEST(FinThrust, GivesTheImpulseOfItsProfileAtEveryTick) {
  const FinThrust fin(kFin, 0.0);
  double impulse_Ns = 0.0;
  for (core::Nanoseconds t = 0; t < 5 * core::kNanosecondsPerSecond; t += core::kPlantTick_ns) {
    impulse_Ns += fin.over_tick(t)[Axis::kY] * core::kPlantTick_s;
    const double s = core::seconds(t + core::kPlantTick_ns) - kFin.start_s;
    ASSERT_NEAR(impulse_Ns, s > 0.0 ? forward_impulse(s) : 0.0, 1e-12) << s;
  }
}

TEST(FinThrust, WorksFromItsStartForItsDurationOnly) {
  const FinThrust fin(kFin, 0.0);
  const auto at = [&](double time_s) { return fin.over_tick(core::nanoseconds(time_s)); };
  EXPECT_EQ(at(0.9999)[Axis::kY], 0.0);
  EXPECT_NE(at(1.0)[Axis::kY], 0.0);
  EXPECT_NE(at(20.9999)[Axis::kY], 0.0);
  EXPECT_EQ(at(21.0)[Axis::kY], 0.0);
  EXPECT_EQ(at(21.0)[Axis::kX], 0.0);
}

// One bin of a Fourier transform over whole periods of both oscillations.
double amplitude_of(const std::vector<double>& signal, double frequency_Hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    sum += signal[i] *
           std::polar(1.0, -kTwoPi * frequency_Hz * static_cast<double>(i) * core::kPlantTick_s);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(signal.size());
}

TEST(FinThrust, OscillatesAtItsFrequencyAlongTheBodyAndAtHalfOfItAcross) {
  const FinThrust fin(kFin, 0.0);
  std::vector<double> forward;
  std::vector<double> left;
  for (int i = 0; i < 200'000; ++i) {  // 74 thrust and 37 side periods
    const PlaneVector force = fin.over_tick(core::kNanosecondsPerSecond + i * core::kPlantTick_ns);
    forward.push_back(force[Axis::kY]);
    left.push_back(-force[Axis::kX]);
  }
  EXPECT_NEAR(amplitude_of(forward, 3.7), 0.4, 1e-6);
  EXPECT_NEAR(amplitude_of(forward, 1.85), 0.0, 1e-9);
  EXPECT_NEAR(amplitude_of(left, 1.85), 0.7, 1e-6);
  EXPECT_NEAR(amplitude_of(left, 3.7), 0.0, 1e-9);
  EXPECT_NEAR(amplitude_of(forward, 0.0) / 2.0, 0.25, 1e-9);
}

// +90 deg turns the nose from +Y to -X.
TEST(FinThrust, TurnsWithTheBody) {
  FinParameters steady{.fitted = true, .mean_thrust_N = 0.5};
  const PlaneVector force = FinThrust(steady, 90.0).over_tick(0);
  EXPECT_NEAR(force[Axis::kX], -0.5, 1e-15);
  EXPECT_NEAR(force[Axis::kY], 0.0, 1e-15);
}

}  // namespace
}  // namespace towbench::emulator
