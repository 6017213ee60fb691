#include "bbmc/system/trajectory/pulse_program.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace towbench::bbmc {
namespace {

// The time of tick k as the control loop computes it.
double tick_time_s(int k, core::Nanoseconds period_ns) {
  return core::seconds(k * period_ns);
}

TEST(PulseProgram, HasTheShapeOfBbmc05ByDefault) {
  const auto program = PulseProgram::make({});
  ASSERT_TRUE(program);
  EXPECT_DOUBLE_EQ(program->duration_s(), 0.5 + 10 * 0.5);
  // Counted in ticks at 1 kHz, by integers: 500 of rest, then 200 on, 300 off.
  for (int k = 0; k < 6000; ++k) {
    const bool on = k >= 500 && k < 5500 && (k - 500) % 500 < 200;
    ASSERT_EQ(program->duty_pct(tick_time_s(k, 1'000'000)), on ? 10.0 : 0.0) << k;
  }
}

TEST(PulseProgram, EveryEdgeFallsOnItsTickAtEveryRate) {
  const auto program = PulseProgram::make({.on_s = 0.1, .off_s = 0.2, .wait_s = 0.3, .pulses = 50});
  ASSERT_TRUE(program);
  for (const int rate_hz : {10, 100, 1000, 5000}) {
    const int per_100ms = rate_hz / 10;
    for (int k = 0; k < 16 * rate_hz; ++k) {
      const int tenth = k / per_100ms - 3;
      const bool on = tenth >= 0 && tenth < 150 && tenth % 3 == 0;
      ASSERT_EQ(program->duty_pct(tick_time_s(k, 1'000'000'000 / rate_hz)), on ? 10.0 : 0.0)
          << k << " at " << rate_hz;
    }
  }
}

TEST(PulseProgram, AlternatingPulsesSumToNothingOverAnEvenNumber) {
  const auto program = PulseProgram::make({.duty_pct = -15, .pulses = 6, .alternate = true});
  ASSERT_TRUE(program);
  double sum = 0;
  double lowest = 0;
  for (int k = 0; k < 4000; ++k) {
    sum += program->duty_pct(tick_time_s(k, 1'000'000));
    lowest = std::fmin(lowest, sum);
  }
  EXPECT_EQ(sum, 0);
  EXPECT_EQ(lowest, -15.0 * 200);
}

TEST(PulseProgram, IsZeroAtEveryTimeThatIsNotItsOwn) {
  const auto program = PulseProgram::make({.wait_s = 0});
  ASSERT_TRUE(program);
  for (const double time_s : {5.0, 1e9, 1e300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    const double duty_pct = program->duty_pct(time_s);
    EXPECT_TRUE(duty_pct == 0 || !(time_s > 0)) << time_s;
  }
}

TEST(PulseProgram, RefusesWhatIsNoPulse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(PulseProgram::make({.duty_pct = 0}));
  EXPECT_FALSE(PulseProgram::make({.duty_pct = 100.1}));
  EXPECT_FALSE(PulseProgram::make({.duty_pct = nan}));
  EXPECT_FALSE(PulseProgram::make({.on_s = 0}));
  EXPECT_FALSE(PulseProgram::make({.on_s = nan}));
  EXPECT_FALSE(PulseProgram::make({.off_s = -1}));
  EXPECT_FALSE(PulseProgram::make({.wait_s = -1}));
  EXPECT_FALSE(PulseProgram::make({.pulses = 0}));
  EXPECT_FALSE(PulseProgram::make({.off_s = 3600, .pulses = 1000}));
}

TEST(BreakAwayProgram, RisesByItsIncrementEveryTwentySamplesToItsLimit) {
  const auto program = BreakAwayProgram::make({});
  ASSERT_TRUE(program);
  for (int k = 0; k < 9000; ++k) {
    const int steps = k / 20 > 400 ? 400 : k / 20;
    ASSERT_NEAR(program->duty_pct(tick_time_s(k, 1'000'000)), 0.05 * steps, 1e-12) << k;
  }
  EXPECT_DOUBLE_EQ(program->duration_s(), 401 * 0.02);
}

TEST(BreakAwayProgram, RefusesRampsThatNeverRiseOrNeverEnd) {
  EXPECT_FALSE(BreakAwayProgram::make({.increment_pct = 0}));
  EXPECT_FALSE(BreakAwayProgram::make({.increment_pct = 1e-300}));
  EXPECT_FALSE(BreakAwayProgram::make({.increment_pct = 30}));
  EXPECT_FALSE(BreakAwayProgram::make({.step_s = 0}));
  EXPECT_FALSE(BreakAwayProgram::make({.limit_pct = -20}));
  EXPECT_FALSE(BreakAwayProgram::make({.limit_pct = std::nan("")}));
}

}  // namespace
}  // namespace towbench::bbmc
