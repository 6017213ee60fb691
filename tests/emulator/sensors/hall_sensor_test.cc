#include "emulator/sensors/hall_sensor.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::emulator {
namespace {

using protocol::InputLine;

constexpr double kPosition_m = 3.9;

// Drives a sensor along x(t) given by the caller, from step 0 on.
template <typename Position, typename Speed>
std::vector<LineChange> follow(HallSensor& sensor, int steps, Position x, Speed v) {
  std::vector<LineChange> all;
  LineChanges changes;
  for (int i = 0; i < steps; ++i) {
    const double from = i * core::kPlantTick_s;
    const double to = (i + 1) * core::kPlantTick_s;
    changes.clear();
    sensor.step(
        i * core::kPlantTick_ns,
        {.before_m = x(from), .before_m_per_s = v(from), .after_m = x(to), .after_m_per_s = v(to)},
        changes);
    all.insert(all.end(), changes.begin(), changes.end());
  }
  return all;
}

HallParameters parameters(double delay_s) {
  return {.position_m = kPosition_m,
          .hysteresis_m = 0.5e-3,
          .latch_release_m = 20e-3,
          .delay_s = delay_s};
}

// x(t) = position + 5 mm sin(2 pi t / 1 s - 0.3): in, out, at times with a closed form.
constexpr double kAmplitude_m = 5e-3;
constexpr double kOmega = 6.283185307179586;
double swing(double t) {
  return kPosition_m + kAmplitude_m * std::sin(kOmega * t - 0.3);
}
double swing_speed(double t) {
  return kAmplitude_m * kOmega * std::cos(kOmega * t - 0.3);
}

TEST(HallSensor, OperatesAtItsPositionAndReleasesBehindItsHysteresisToTheNanosecond) {
  HallSensor sensor(parameters(0.0), TravelEnd::kMax, InputLine::kHallYMax, swing(0));
  const auto changes = follow(sensor, 9000, swing, swing_speed);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_TRUE(changes[0].active);
  EXPECT_EQ(changes[0].line, InputLine::kHallYMax);
  EXPECT_NEAR(static_cast<double>(changes[0].time_ns), 0.3 / kOmega * 1e9, 2.0);
  EXPECT_FALSE(changes[1].active);
  const double release_s = (0.3 + 3.141592653589793 + std::asin(0.1)) / kOmega;
  EXPECT_NEAR(static_cast<double>(changes[1].time_ns), release_s * 1e9, 2.0);
}

TEST(HallSensor, ShiftsBothChangesByItsDelayAcrossSteps) {
  HallSensor prompt(parameters(0.0), TravelEnd::kMax, InputLine::kHallYMax, swing(0));
  HallSensor late(parameters(0.73e-3), TravelEnd::kMax, InputLine::kHallYMax, swing(0));
  const auto before = follow(prompt, 9000, swing, swing_speed);
  const auto after = follow(late, 9000, swing, swing_speed);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].time_ns - before[i].time_ns, 730'000);
    EXPECT_EQ(after[i].active, before[i].active);
  }
}

TEST(HallSensor, AtTheMinEndMirrorsTheMaxEnd) {
  const auto mirrored = [](double t) { return 2.0 * kPosition_m - swing(t); };
  const auto mirrored_speed = [](double t) { return -swing_speed(t); };
  HallSensor max(parameters(0.0), TravelEnd::kMax, InputLine::kHallYMax, swing(0));
  HallSensor min(parameters(0.0), TravelEnd::kMin, InputLine::kHallYMin, mirrored(0));
  const auto at_max = follow(max, 9000, swing, swing_speed);
  const auto at_min = follow(min, 9000, mirrored, mirrored_speed);
  ASSERT_EQ(at_max.size(), at_min.size());
  for (std::size_t i = 0; i < at_max.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(at_max[i].time_ns), static_cast<double>(at_min[i].time_ns), 1);
    EXPECT_EQ(at_max[i].active, at_min[i].active);
  }
}

TEST(HallSensor, LatchingStaysActiveUntilTheOppositePole) {
  HallParameters latching = parameters(0.0);
  latching.latching = true;
  HallSensor sensor(latching, TravelEnd::kMax, InputLine::kHallYMax, kPosition_m - 0.001);
  // In by 2 mm, then back at 0.1 m/s: releases 20 mm before the position, not 0.5 mm.
  const auto x = [](double t) {
    return t < 0.03 ? kPosition_m - 0.001 + 0.1 * t : kPosition_m + 0.002 - 0.1 * (t - 0.03);
  };
  const auto v = [](double t) { return t < 0.03 ? 0.1 : -0.1; };
  const auto changes = follow(sensor, 4000, x, v);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_NEAR(static_cast<double>(changes[0].time_ns), 0.010e9, 5.0);
  EXPECT_NEAR(static_cast<double>(changes[1].time_ns), (0.03 + 0.22) * 1e9, 5.0);
}

TEST(HallSensor, LeavesNoTraceOfATouchShorterThanItsDelay) {
  // Deeper than the hysteresis both ways, 0.4 ms inside: x = position + 1 mm (1 - (t - 10 ms)^2 k).
  const double k = 1.0 / (0.2e-3 * 0.2e-3);
  const auto x = [k](double t) { return kPosition_m + 1e-3 * (1.0 - k * (t - 0.01) * (t - 0.01)); };
  const auto v = [k](double t) { return -2e-3 * k * (t - 0.01); };
  HallSensor slow(parameters(0.9e-3), TravelEnd::kMax, InputLine::kHallYMax, x(0.009));
  HallSensor quick(parameters(0.1e-3), TravelEnd::kMax, InputLine::kHallYMax, x(0.009));
  EXPECT_TRUE(follow(slow, 110, x, v).empty());
  EXPECT_EQ(follow(quick, 110, x, v).size(), 2U);
}

TEST(HallSensor, SeesAVisitThatBeginsAndEndsInsideOneStep) {
  // Passes the position by 10 um in mid step and has left the 2 um hysteresis at its end.
  HallParameters fine = parameters(0.0);
  fine.hysteresis_m = 2e-6;
  const double rate = 4.0 * 20e-6 / core::kPlantTick_s;
  HallSensor sensor(fine, TravelEnd::kMax, InputLine::kHallYMax, kPosition_m - 10e-6);
  LineChanges changes;
  sensor.step(0,
              {.before_m = kPosition_m - 10e-6,
               .before_m_per_s = rate,
               .after_m = kPosition_m - 10e-6,
               .after_m_per_s = -rate},
              changes);
  ASSERT_EQ(changes.size(), 2U);
  // 80 u (1 - u) = 10 on the way in, = 8 on the way out.
  EXPECT_NEAR(static_cast<double>(changes[0].time_ns), (0.5 - std::sqrt(0.25 - 0.125)) * 1e5, 2);
  EXPECT_NEAR(static_cast<double>(changes[1].time_ns), (0.5 + std::sqrt(0.25 - 0.1)) * 1e5, 2);
  EXPECT_FALSE(sensor.active());
}

TEST(HallSensor, IsActiveFromTheStartWhenTheCarriageStartsThere) {
  EXPECT_TRUE(HallSensor(parameters(1e-4), TravelEnd::kMax, InputLine::kHallYMax, 3.91).active());
  EXPECT_FALSE(HallSensor(parameters(1e-4), TravelEnd::kMax, InputLine::kHallYMax, 3.89).active());
}

TEST(HallSensor, NotFittedNeverChanges) {
  HallParameters missing = parameters(0.0);
  missing.fitted = false;
  HallSensor sensor(missing, TravelEnd::kMax, InputLine::kHallYMax, 3.95);
  EXPECT_FALSE(sensor.active());
  EXPECT_TRUE(follow(sensor, 9000, swing, swing_speed).empty());
}

}  // namespace
}  // namespace towbench::emulator
