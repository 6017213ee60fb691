// A brake whose speed comes late, or that nobody has served for a while, neither swings nor gives
// up. Judged on two bodies on a spring, integrated here: the motor answers at once, the carriage
// follows over the chain.
#include <algorithm>
#include <cmath>
#include <deque>

#include <gtest/gtest.h>

#include "bbmc/system/brake.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/dead_reckoning.h"
#include "bbmc/system/encoder_plausibility.h"
#include "bbmc/system/stopping_distance.h"
#include "core/axis.h"

namespace towbench::tests {
namespace {

using bbmc::BrakeState;
using core::kNanosecondsPerMillisecond;

constexpr double kDampingRatio = 0.02;  // of the chain; less than the nominal rig assumes
constexpr double kPi = 3.14159265358979323846;

// At the motor. Dry friction is half of what the controller expects at worst, most of it at the
// carriage.
class TwoBodies {
 public:
  TwoBodies(const bbmc::AxisConfiguration& axis, double speed_m_per_s)
      : rotor_kg_m2_(axis.braking.rotor_inertia_kg_m2),
        carriage_kg_m2_(axis.braking.inertia_kg_m2 - rotor_kg_m2_),
        friction_Nm_(0.5 * axis.plausibility.worst_breakaway_Nm),
        rotor_rad_per_s_(speed_m_per_s / axis.m_per_rad()),
        carriage_rad_per_s_(rotor_rad_per_s_) {
    const double held_rad_per_s = 2 * kPi * axis.braking.held_motor_chain_Hz;
    stiffness_Nm_per_rad_ = carriage_kg_m2_ * held_rad_per_s * held_rad_per_s;
    damping_Nm_s_per_rad_ = 2 * kDampingRatio * carriage_kg_m2_ * held_rad_per_s;
  }

  // One millisecond, semi-implicit Euler in steps of 10 us.
  void advance(double torque_Nm) {
    constexpr double kStep_s = 1e-5;
    for (int i = 0; i < 100; ++i) {
      const double chain_Nm = stiffness_Nm_per_rad_ * (carriage_rad_ - rotor_rad_) +
                              damping_Nm_s_per_rad_ * (carriage_rad_per_s_ - rotor_rad_per_s_);
      const double rotor_friction_Nm = 0.3 * friction_Nm_ * std::tanh(rotor_rad_per_s_ / 5);
      const double carriage_friction_Nm = 0.7 * friction_Nm_ * std::tanh(carriage_rad_per_s_ / 5);
      rotor_rad_per_s_ += kStep_s * (torque_Nm + chain_Nm - rotor_friction_Nm) / rotor_kg_m2_;
      carriage_rad_per_s_ -= kStep_s * (chain_Nm + carriage_friction_Nm) / carriage_kg_m2_;
      rotor_rad_ += kStep_s * rotor_rad_per_s_;
      carriage_rad_ += kStep_s * carriage_rad_per_s_;
    }
  }

  [[nodiscard]] double rotor_rad_per_s() const { return rotor_rad_per_s_; }
  [[nodiscard]] double carriage_rad() const { return carriage_rad_; }
  [[nodiscard]] double friction_Nm() const { return friction_Nm_; }

 private:
  double rotor_kg_m2_;
  double carriage_kg_m2_;
  double friction_Nm_;
  double stiffness_Nm_per_rad_ = 0;
  double damping_Nm_s_per_rad_ = 0;
  double rotor_rad_ = 0;
  double rotor_rad_per_s_;
  double carriage_rad_ = 0;
  double carriage_rad_per_s_;
};

struct Stop {
  double furthest_m = 0;       // of the carriage, from where the brake begins
  double fastest_m_per_s = 0;  // of the motor, later than 0.3 s
};

// Cruise for 0.2 s, then brake for 0.6 s with a speed that is `delay_ms` old; `told_ms` is what the
// brake is told of that.
Stop stop(core::Axis axis, double speed_m_per_s, int delay_ms, int told_ms) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[axis];
  bbmc::Brake brake(settings);
  bbmc::DeadReckoning reckoning(settings);
  TwoBodies bodies(settings, speed_m_per_s);
  std::deque<double> told(static_cast<std::size_t>(delay_ms) + 1, bodies.rotor_rad_per_s());
  Stop result;
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
    result.furthest_m =
        std::max(result.furthest_m, (bodies.carriage_rad() - begun_rad) * settings.m_per_rad());
    if (ms > 500) {
      result.fastest_m_per_s = std::max(result.fastest_m_per_s,
                                        std::fabs(bodies.rotor_rad_per_s()) * settings.m_per_rad());
    }
  }
  return result;
}

class LateBraking : public ::testing::TestWithParam<core::Axis> {};

TEST_P(LateBraking, StopsWhereAPromptSpeedWouldAndComesToRest) {
  for (const double speed_m_per_s : {0.05, 0.2, 0.5}) {
    const Stop prompt = stop(GetParam(), speed_m_per_s, 0, 0);
    for (const int delay_ms : {4, 8, 16}) {
      const Stop late = stop(GetParam(), speed_m_per_s, delay_ms, delay_ms);
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
    const double swing = 50'000.0 * std::sin(2 * kPi * ms / 36.0);
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
