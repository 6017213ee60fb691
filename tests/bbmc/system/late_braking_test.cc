// A brake whose speed comes late, or that nobody has served for a while, neither swings nor gives
// up. Judged on two bodies on a spring (two_bodies.h).
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include <gtest/gtest.h>

#include "bbmc/system/brake.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/dead_reckoning.h"
#include "bbmc/system/encoder_plausibility.h"
#include "bbmc/system/stopping_distance.h"
#include "core/axis.h"
#include "tests/bbmc/system/two_bodies.h"

namespace towbench::tests {
namespace {

using bbmc::BrakeState;
using core::kNanosecondsPerMillisecond;

struct LateStop {
  double furthest_m = 0;       // of the carriage, from where the brake begins
  double fastest_m_per_s = 0;  // of the motor, later than 0.3 s
};

// Cruise for 0.2 s, then brake for 0.6 s with a speed that is `delay_ms` old; `told_ms` is what the
// brake is told of that.
LateStop stop(core::Axis axis, double speed_m_per_s, int delay_ms, int told_ms) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[axis];
  bbmc::Brake brake(settings);
  bbmc::DeadReckoning reckoning(settings);
  TwoBodies bodies(settings, speed_m_per_s);
  std::deque<double> told(static_cast<std::size_t>(delay_ms) + 1, bodies.rotor_rad_per_s());
  LateStop result;
  double torque_Nm = bodies.friction_Nm();
  double begun_rad = 0;
  for (int ms = 1; ms <= 800; ++ms) {
    const core::Nanoseconds now_ns = ms * kNanosecondsPerMillisecond;
    bodies.advance(torque_Nm);
    told.push_back(bodies.rotor_rad_per_s());
    told.pop_front();
    const double speed_count_per_s = told.front() / settings.rad_per_count();
    reckoning.update(now_ns, speed_count_per_s, torque_Nm, 1e-3);
    if (ms < 200) {
      continue;
    }
    if (ms == 200) {
      brake.begin({.now_ns = now_ns, .speed_count_per_s = speed_count_per_s}, false);
      begun_rad = bodies.carriage_rad();
    }
    (void)brake.update({.now_ns = now_ns,
                        .speed_count_per_s = speed_count_per_s,
                        .age_ns = told_ms * kNanosecondsPerMillisecond,
                        .momentum_count_per_s = reckoning.momentum_count_per_s()});
    torque_Nm = brake.torque_Nm();
    result.furthest_m = std::max(
        result.furthest_m, (bodies.carriage_rad() - begun_rad) * settings.metres_per_motor_rad());
    if (ms > 500) {
      result.fastest_m_per_s =
          std::max(result.fastest_m_per_s,
                   std::fabs(bodies.rotor_rad_per_s()) * settings.metres_per_motor_rad());
    }
  }
  return result;
}

class LateBraking : public ::testing::TestWithParam<core::Axis> {};

TEST_P(LateBraking, StopsWhereAPromptSpeedWouldAndComesToRest) {
  for (const double speed_m_per_s : {0.05, 0.2, 0.5}) {
    const LateStop prompt = stop(GetParam(), speed_m_per_s, 0, 0);
    for (const int delay_ms : {4, 8, 16}) {
      const LateStop late = stop(GetParam(), speed_m_per_s, delay_ms, delay_ms);
      EXPECT_GT(late.furthest_m, 0.5 * prompt.furthest_m)
          << speed_m_per_s << " m/s " << delay_ms << " ms";
      EXPECT_LT(late.furthest_m, 1.05 * prompt.furthest_m)
          << speed_m_per_s << " m/s " << delay_ms << " ms";
      EXPECT_LT(late.fastest_m_per_s, 0.6 * speed_m_per_s)
          << speed_m_per_s << " m/s " << delay_ms << " ms";
    }
  }
}

// What the brake does about it is what keeps it calm.
TEST_P(LateBraking, SwingsForEverWhenNobodyHeedsTheDelay) {
  EXPECT_GT(stop(GetParam(), 0.2, 8, 0).fastest_m_per_s, 0.7 * 0.2);
}

INSTANTIATE_TEST_SUITE_P(BothAxes, LateBraking, ::testing::Values(core::Axis::kY, core::Axis::kX),
                         [](const auto& which) { return std::string(core::name_of(which.param)); });

TEST(Momentum, IsTheSpeedOfTheAxisAndNotOfTheSwingingMotor) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  bbmc::DeadReckoning reckoning(settings);
  for (int ms = 1; ms <= 200; ++ms) {
    const double swing = 50'000.0 * std::sin(2 * std::numbers::pi * ms / 36.0);
    reckoning.update(ms * kNanosecondsPerMillisecond, 100'000.0 + swing, 0.0, 1e-3);
  }
  EXPECT_NEAR(reckoning.momentum_count_per_s(), 100'000.0, 10'000.0);
}

TEST(Momentum, OfAnAxisThatStandsIsNothingHoweverLongItIsHeld) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  bbmc::DeadReckoning reckoning(settings);
  for (int ms = 1; ms <= 200; ++ms) {
    reckoning.update(ms * kNanosecondsPerMillisecond, 0.0, 0.01, 1e-3);
  }
  EXPECT_EQ(reckoning.momentum_count_per_s(), 0.0);
}

// ---- after a host that slept ----

TEST(BrakeAfterAGap, FindsNoRunawayAndTakesTheMomentumOut) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  bbmc::Brake brake(settings);
  constexpr double kSpeed_count_per_s = 90'000;
  brake.begin({.speed_count_per_s = 100'000}, false);
  (void)brake.update({.now_ns = kNanosecondsPerMillisecond, .speed_count_per_s = 100'000});
  // As fast as this after 0.45 s would be a drive that pushes, had anybody looked meanwhile.
  EXPECT_EQ(brake.update({.now_ns = 450 * kNanosecondsPerMillisecond,
                          .speed_count_per_s = kSpeed_count_per_s,
                          .momentum_count_per_s = kSpeed_count_per_s}),
            BrakeState::kBraking);
  // The motor stands against the chain, the axis as a whole does not.
  EXPECT_EQ(brake.update({.now_ns = 455 * kNanosecondsPerMillisecond,
                          .momentum_count_per_s = kSpeed_count_per_s}),
            BrakeState::kBraking);
  EXPECT_EQ(brake.torque_Nm(), -bbmc::braking_torque_Nm(settings));
}

TEST(MomentumAfterAGap, IsTheMeanOfItWhereTheMotorJustSwingsBack) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  const auto momentum = [&](double mean_count_per_s, double then_count_per_s) {
    bbmc::DeadReckoning reckoning(settings);
    core::Nanoseconds now_ns = 0;
    const auto see = [&](double elapsed_s, double speed_count_per_s) {
      now_ns += core::nanoseconds(elapsed_s);
      reckoning.update(now_ns, speed_count_per_s, 0.0, elapsed_s);
    };
    see(1e-3, 20'000);
    see(0.2, mean_count_per_s);
    see(1e-3, then_count_per_s);
    return reckoning.momentum_count_per_s();
  };
  EXPECT_NEAR(momentum(24'000, 7'000), 24'000, 1);
  EXPECT_NEAR(momentum(24'000, 60'000), 60'000, 1);  // it was driven on meanwhile
  EXPECT_EQ(momentum(24'000, 0), 0);                 // it stands
  EXPECT_NEAR(momentum(24'000, -30'000), -30'000, 1);
}

TEST(EncoderAfterAGap, MayHaveTurnedRoundWithoutNoiseOrJump) {
  bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  settings.plausibility.index_fitted = false;
  bbmc::EncoderPlausibility plausibility(settings);
  bbmc::EncoderChange change;
  const auto after = [&](double elapsed_s, std::int64_t counts, std::uint32_t edges) {
    change.time_ns += core::nanoseconds(elapsed_s);
    change.elapsed_s = elapsed_s;
    change.counts = counts;
    change.raw_count += counts;
    change.edges = edges;
    return plausibility.update(change, bbmc::EncoderPlausibility::Scope::kSignals);
  };
  (void)after(1e-3, 10, 10);
  EXPECT_EQ(after(1e-3, 20, 20), core::ErrorCode::kNone);
  EXPECT_EQ(after(0.2, 10'000, 50'000), core::ErrorCode::kNone);
  EXPECT_EQ(after(1e-3, -250, 250), core::ErrorCode::kNone);
  // Looked at every millisecond it is as strict as ever.
  EXPECT_NE(after(1e-3, 250, 250), core::ErrorCode::kNone);
}

}  // namespace
}  // namespace towbench::tests
