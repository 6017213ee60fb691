// An encoder that is not believed any more does not make the carriage coast: the axis brakes from
// the speed that it had, for as long as that takes. Judged by the plant's truth.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/brake.h"
#include "bbmc/system/dead_reckoning.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using bbmc::BrakeState;
using core::Axis;
using core::kNanosecondsPerMillisecond;
using protocol::EncoderEdge;
using protocol::EncoderEdges;
using protocol::EncoderLine;

// From a moment on, A is taken for B and B for A; or nothing comes any more.
struct Lie {
  double from_s = 0;
  bool frozen = false;
  protocol::EncoderLevels levels = 0;
  bool begun = false;

  void operator()(EncoderEdges& message) {
    if (message.axis != Axis::kY || message.end_ns <= core::nanoseconds(from_s)) {
      return;
    }
    EncoderEdges changed = message;
    changed.edges.clear();
    changed.start_levels = begun ? levels : message.start_levels;
    begun = true;
    levels = changed.start_levels;
    for (const EncoderEdge edge : message.edges.view()) {
      if (frozen) {
        continue;
      }
      const EncoderLine line = edge.line() == EncoderLine::kA   ? EncoderLine::kB
                               : edge.line() == EncoderLine::kB ? EncoderLine::kA
                                                                : edge.line();
      ASSERT_TRUE(
          changed.edges.push_back(EncoderEdge(static_cast<std::uint32_t>(edge.step_ns()), line)));
      levels = static_cast<std::uint8_t>(levels ^ (1U << static_cast<unsigned>(line)));
    }
    message = changed;
  }
};

// How far the carriage runs on, from the latched fault until it stands for the first time.
double way_to_standstill_m(const Machine& machine) {
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  if (latched == nullptr) {
    return -1;
  }
  double from_m = 0;
  for (const auto& row : machine.truth) {
    if (row.time_ns <= latched->time_ns) {
      from_m = row.axes[Axis::kY].carriage_m;
    } else if (row.axes[Axis::kY].carriage_speed_m_per_s <= 0) {
      return row.axes[Axis::kY].carriage_m - from_m;
    }
  }
  return machine.truth.back().axes[Axis::kY].carriage_m - from_m;
}

double way_after(Lie lie, bool coasting) {
  Machine::Options options;
  options.configuration.safety.coasting_stop = coasting;
  Machine machine(options);
  machine.disturb_edges = lie;
  EXPECT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.8, 0.5)));
  EXPECT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.status(Axis::kY).mode, bbmc::AxisMode::kFaulted);
  machine.run_for(2.0);
  return way_to_standstill_m(machine);
}

// v^2 / 2a of the rigid axis at its brake's torque, without friction.
double rigid_way_m(double speed_m_per_s) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[Axis::kY];
  const double acceleration_m_per_s2 = bbmc::braking_torque_Nm(settings) /
                                       settings.braking.inertia_kg_m2 *
                                       settings.metres_per_motor_rad();
  return speed_m_per_s * speed_m_per_s / (2 * acceleration_m_per_s2);
}

TEST(BlindBraking, StopsAFrozenOrSwappedEncodersAxisInTheWayThatTheDriveNeeds) {
  for (const bool frozen : {true, false}) {
    const double way_m = way_after({.from_s = 1.0, .frozen = frozen}, false);
    // The chain's swing lets the carriage run on a little; friction helps.
    EXPECT_GT(way_m, 0.8 * rigid_way_m(0.5)) << frozen;
    EXPECT_LT(way_m, 1.5 * rigid_way_m(0.5) + 3e-3) << frozen;
  }
}

TEST(BlindBraking, IsWhatStopsIt) {
  EXPECT_GT(way_after({.from_s = 1.0, .frozen = true}, true), 5 * rigid_way_m(0.5));
}

TEST(BlindBraking, IsNotTriedWithAnEncoderThatIsWrongFromTheStart) {
  Machine machine;
  machine.disturb_edges = Lie{.from_s = 0.0};
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.8, 0.5)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  ASSERT_NE(latched, nullptr);
  for (const auto& row : machine.rows) {
    if (row.time_ns > latched->time_ns + kNanosecondsPerMillisecond) {
      EXPECT_EQ(row.axes[Axis::kY].duty_pct, 0.0) << core::seconds(row.time_ns);
    }
  }
}

TEST(BlindBraking, EndsAtOnceWhenTheKillSwitchIsPressed) {
  Machine::Options options;
  options.events.push_back(
      {.time_ns = core::nanoseconds(1.03), .kind = emulator::ScheduledEventKind::kPressKillSwitch});
  Machine machine(options);
  machine.disturb_edges = Lie{.from_s = 1.0};
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.8, 0.5)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  bool braked = false;
  for (const auto& duty : machine.duties) {
    const bool driven = duty.message.axis == Axis::kY && duty.message.enable &&
                        duty.message.channel_a_ticks != duty.message.channel_b_ticks;
    braked = braked || (driven && duty.time_ns > core::nanoseconds(1.02) &&
                        duty.time_ns < core::nanoseconds(1.03));
    EXPECT_FALSE(driven && duty.time_ns > core::nanoseconds(1.032)) << core::seconds(duty.time_ns);
  }
  EXPECT_TRUE(braked);
}

// ---- the brake by itself ----

class BlindBrake : public ::testing::Test {
 protected:
  // Milliseconds of torque with an encoder that says `speed(ms)`, counts per second.
  template <class Speed>
  int lasts_ms(double start_count_per_s, Speed speed) {
    const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[Axis::kY];
    bbmc::Brake brake(settings);
    brake.begin_blind(0, start_count_per_s, true);
    int ms = 0;
    while (ms < 1000 && brake.update({.now_ns = ms * kNanosecondsPerMillisecond,
                                      .speed_count_per_s = speed(ms)}) == BrakeState::kBraking) {
      EXPECT_EQ(brake.torque_Nm(), -bbmc::braking_torque_Nm(settings));
      ++ms;
    }
    EXPECT_EQ(brake.torque_Nm(), 0.0);
    return ms;
  }
  static constexpr double kStart_count_per_s = 200'000;
  [[nodiscard]] static double stands_ms() {
    const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[Axis::kY];
    return 1e3 * kStart_count_per_s * settings.rad_per_count() * settings.braking.inertia_kg_m2 /
           bbmc::braking_torque_Nm(settings);
  }
};

TEST_F(BlindBrake, LastsATenthLongerThanARigidAxisNeeds) {
  EXPECT_NEAR(lasts_ms(kStart_count_per_s, [](int) { return 0.0; }), 1.1 * stands_ms(), 1.0);
}

TEST_F(BlindBrake, GoesOnWhenASwappedEncoderSaysThatItGoesBackwards) {
  EXPECT_NEAR(lasts_ms(kStart_count_per_s, [](int) { return -kStart_count_per_s; }),
              1.1 * stands_ms(), 1.0);
}

TEST_F(BlindBrake, EndsWhenAnObstacleHasStoppedTheAxisAndItIsPushedBack) {
  const auto bounces = [](int ms) { return kStart_count_per_s * (1.0 - 0.2 * ms); };
  EXPECT_LT(lasts_ms(kStart_count_per_s, bounces), 12);
}

TEST_F(BlindBrake, EndsWhenTheAxisGetsFaster) {
  const auto runs_away = [](int ms) { return kStart_count_per_s * (1.0 + 0.05 * ms); };
  EXPECT_LT(lasts_ms(kStart_count_per_s, runs_away), 12);
}

TEST_F(BlindBrake, BearsABurstOfNonsense) {
  const auto jumps = [](int ms) { return ms < 4 ? 50.0 * kStart_count_per_s : 0.0; };
  EXPECT_NEAR(lasts_ms(kStart_count_per_s, jumps), 1.1 * stands_ms(), 1.0);
}

// ---- what it starts from ----

TEST(DeadReckoning, IsTheSpeedOfOldAndWhatTheDriveHasDoneSince) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[Axis::kY];
  bbmc::DeadReckoning reckoning(settings);
  constexpr double kTorque_Nm = -0.01;
  // Cruise for 0.2 s, then 40 ms in which the encoder says nothing while the drive pushes back.
  for (int ms = 1; ms <= 240; ++ms) {
    reckoning.update(ms * kNanosecondsPerMillisecond, ms <= 200 ? 150'000.0 : 0.0,
                     ms <= 200 ? 0.0 : kTorque_Nm, 1e-3);
  }
  const double lost_count_per_s =
      -kTorque_Nm * 0.040 / settings.braking.inertia_kg_m2 / settings.rad_per_count();
  EXPECT_NEAR(reckoning.speed_count_per_s(), 150'000.0 - lost_count_per_s, 1.0);
}

TEST(DeadReckoning, KnowsNothingOfSlowAxesAndOfThoseThatTurnedRound) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[Axis::kY];
  bbmc::DeadReckoning slow(settings);
  bbmc::DeadReckoning turned(settings);
  const double slow_count_per_s = 0.07 * settings.counts_per_m();
  for (int ms = 1; ms <= 100; ++ms) {
    slow.update(ms * kNanosecondsPerMillisecond, slow_count_per_s, 0.0, 1e-3);
    turned.update(ms * kNanosecondsPerMillisecond, 60'000.0, -0.09, 1e-3);
  }
  EXPECT_EQ(slow.speed_count_per_s(), 0.0);
  EXPECT_EQ(turned.speed_count_per_s(), 0.0);
}

}  // namespace
}  // namespace towbench::tests
