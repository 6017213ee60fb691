// Estimators against motion whose speed is known, through the real decoder: edges at exact times.
#include "bbmc/system/velocity_estimator.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/bbmc/support/encoder_bench.h"

namespace towbench::bbmc {
namespace {

using Bench = tests::EncoderBench;

double rms_error(VelocityMethod method, double speed, double rate_Hz) {
  return tests::velocity_error(method, speed, rate_Hz).rms;
}

TEST(VelocityEstimator, FrequencyErrorIsItsQuantum3_48AndPeriodErrorIsItsOwn) {
  // Differences of a floor: sqrt(f (1 - f)) quanta, 0.41 on average over the fraction f.
  EXPECT_NEAR(rms_error(VelocityMethod::kFrequency, 20'000, 1000.0) / 1000.0, 0.4, 0.2);
  const double quantum = 20'000.0 * 20'000.0 / 1.5625e6;
  EXPECT_NEAR(rms_error(VelocityMethod::kPeriod, 20'000, 1000.0) / quantum, 0.4, 0.2);
}

// Thesis (3.58)-(3.59) with the omega that the print lacks: both quanta are equal at sqrt(f_s f_c).
TEST(Defect8HybridVelocity, SwitchesWhereTheErrorsCrossNotAtTenThousand) {
  const VelocityEstimator at_1_kHz({}, 1000.0);
  EXPECT_NEAR(at_1_kHz.switching_speed_counts_per_s(), 39'528, 1.0);
  const double v = at_1_kHz.switching_speed_counts_per_s();
  const double ratio = rms_error(VelocityMethod::kPeriod, v, 1000.0) /
                       rms_error(VelocityMethod::kFrequency, v, 1000.0);
  EXPECT_NEAR(ratio, 1.0, 0.35);
  // At the original's 10,000 counts/s the frequency value is more than ten times worse.
  EXPECT_GT(rms_error(VelocityMethod::kFrequency, 10'000, 1000.0),
            10 * rms_error(VelocityMethod::kPeriod, 10'000, 1000.0));
}

// 0.2 mm/s on Y is 89 counts/s; its top speed is 254,000, X's 283,000. The grid is fine around the
// switching speed, where both are wrong by the same.
TEST(Defect8HybridVelocity, IsWithinTenPerCentOfTheBetterOfTheTwoEverywhere) {
  const double v_sw = VelocityEstimator({}, 1000.0).switching_speed_counts_per_s();
  for (double v = 89; v<400'000; v *= v> 0.85 * v_sw && v < 1.2 * v_sw ? 1.02 : 1.23) {
    const double better = std::min(rms_error(VelocityMethod::kFrequency, v, 1000.0),
                                   rms_error(VelocityMethod::kPeriod, v, 1000.0));
    EXPECT_LE(rms_error(VelocityMethod::kHybrid, v, 1000.0), 1.1 * better + 1e-9) << v;
  }
}

TEST(Defect8HybridVelocity, HasHysteresisSoThatASteadySpeedDoesNotSwitch) {
  Bench bench(VelocityMethod::kHybrid, 1000.0);
  const double v = 39'528;
  int switches = 0;
  bool last = false;
  for (int k = 0; k < 1'000; ++k) {
    static_cast<void>(bench.sample([v](double t) { return v * t; }));
    switches += bench.estimator().uses_frequency() != last ? 1 : 0;
    last = bench.estimator().uses_frequency();
  }
  EXPECT_LE(switches, 1);
}

TEST(Defect8VelocityGlitch, NoSampleDropsToZeroAtSteadySlowMotion) {
  // 89 counts/s: one edge in 11 samples; the samples between repeat.
  for (const VelocityMethod method : {VelocityMethod::kPeriod, VelocityMethod::kHybrid}) {
    Bench bench(method, 1000.0);
    for (int k = 0; k < 2'000; ++k) {
      const double estimate = bench.sample([](double t) { return 89.0 * t + 0.5; });
      if (k > 30) {
        ASSERT_NEAR(estimate, 89.0, 89.0 * 0.01) << k;
      }
    }
  }
}

TEST(VelocityEstimator, DecaysWhenTheNextEdgeIsOverdueAndIsZeroAfterTheTimeOut) {
  Bench bench(VelocityMethod::kPeriod, 1000.0, 0.03);
  const auto stops = [](double t) { return t < 0.1 ? 2'000.0 * t : 200.0; };
  double last = 0;
  for (int k = 0; k < 100; ++k) {
    last = bench.sample(stops);
  }
  EXPECT_NEAR(last, 2'000, 20);
  for (int k = 0; k < 28; ++k) {
    const double now = bench.sample(stops);
    EXPECT_LE(now, last + 1e-9);
    last = now;
  }
  EXPECT_GT(last, 0.0);
  for (int k = 0; k < 5; ++k) {
    last = bench.sample(stops);
  }
  EXPECT_EQ(last, 0.0);
}

TEST(VelocityEstimator, FollowsTheSignThroughAReversal) {
  Bench bench(VelocityMethod::kHybrid, 1000.0);
  const auto swings = [](double t) { return 3'000.0 * std::sin(6.28 * t); };
  for (int k = 0; k < 1'000; ++k) {
    const double t = 1e-3 * (k + 1);
    const double truth = 3'000.0 * 6.28 * std::cos(6.28 * (t - 0.5e-3));
    const double estimate = bench.sample(swings);
    if (k > 1) {  // a difference needs two samples
      EXPECT_NEAR(estimate, truth, 700.0) << k;
    }
  }
}

TEST(VelocityEstimator, WorksAtTenHertzAndAtFiveKilohertz) {
  for (const double rate_Hz : {10.0, 5000.0}) {
    Bench bench(VelocityMethod::kHybrid, rate_Hz);
    double estimate = 0;
    for (int k = 0; k < 60; ++k) {
      estimate = bench.sample([](double t) { return -12'345.0 * t; });
    }
    EXPECT_NEAR(estimate, -12'345.0, 150.0) << rate_Hz;
  }
}

}  // namespace
}  // namespace towbench::bbmc
