// What control rate a loop needs: docs/measurements/control-rate.md in full.
#include <gtest/gtest.h>

#include "tests/bbmc/support/rated_run.h"

namespace towbench::tests {
namespace {

constexpr double kSlow_m_per_s = 0.05;

RatedRun run_loop(double rate_Hz, double speed_ratio) {
  return run_at_rate(rated(rate_Hz, gains_for_loop(speed_ratio), false), kSlow_m_per_s);
}

TEST(ControlRate, TheTunedLoopSwingsAtAHundredHertzAndNotAtTwoHundredAndFifty) {
  const auto slow = run_loop(100, 1);
  const auto fast = run_loop(250, 1);
  EXPECT_GT(slow.steady_rms_m, 1e-3);
  EXPECT_TRUE(fast.follows());
  EXPECT_LT(fast.peak_m, 0.15e-3);
  EXPECT_GT(fast.peak_m, 0.02e-3);
}

// Thesis ch. 4: a control rate of at least 100 Hz.
TEST(ControlRate, AHundredHertzCarryALoopHalfAsFast) {
  const auto run = run_loop(100, 0.5);
  ASSERT_TRUE(run.follows());
  EXPECT_LT(run.peak_m, 0.7e-3);
  EXPECT_GT(run.peak_m, 0.2e-3);
}

TEST(ControlRate, TenHertzCarryALoopOfAnEighthAndNoneOfAQuarter) {
  const auto soft = run_loop(10, 0.125);
  ASSERT_TRUE(soft.follows());
  EXPECT_LT(soft.peak_m, 12e-3);
  EXPECT_GT(soft.peak_m, 4e-3);
  EXPECT_FALSE(run_loop(10, 0.25).follows());
  EXPECT_TRUE(run_loop(100, 0.25).follows()) << "it was the rate";
}

// What is stable at 1 Hz does not break the axis away within the tracking limit.
TEST(ControlRate, AtOneHertzALoopIsTooSoftOrRefused) {
  for (const double loop : {1.0 / 64, 1.0 / 32}) {
    EXPECT_EQ(run_loop(1, loop).fault, core::ErrorCode::kFaultTrackingError) << loop;
  }
  EXPECT_NE(bbmc::inconsistency(rated(1, gains_for_loop(1.0 / 16), false)), nullptr);
}

}  // namespace
}  // namespace towbench::tests
