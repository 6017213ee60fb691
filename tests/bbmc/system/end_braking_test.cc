// A stop that an end-stop asked for, with a carriage that swings on its chain: what counts is where
// the carriage stops, not the motor. Judged on two bodies on a spring (two_bodies.h).
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "bbmc/system/brake.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/dead_reckoning.h"
#include "bbmc/system/stopping_distance.h"
#include "tests/bbmc/system/two_bodies.h"

namespace towbench::tests {
namespace {

using bbmc::BrakeState;
using core::kNanosecondsPerMillisecond;

// docs/reference/constants.md: from the switch to the hard end.
constexpr double kYMaxRoom_m = 0.045;
constexpr double kYMinRoom_m = 0.0022;

struct Stop {
  double furthest_m = 0;  // of the carriage, from where the brake begins
  std::vector<double> torques_Nm;
  std::optional<int> gave_up_ms;  // after the brake began
};

bbmc::AxisConfiguration nominal_y() {
  return bbmc::Configuration().axes[core::Axis::kY];
}

class BrakedAxis {
 public:
  // `built` as it is, whatever the controller was told.
  BrakedAxis(double speed_m_per_s, double carriage_m_per_s,
             const bbmc::AxisConfiguration& built = nominal_y())
      : settings_(nominal_y()),
        speed_rad_per_s_(speed_m_per_s / settings_.metres_per_motor_rad()),
        limit_Nm_(settings_.drive.torque_limit_Nm()),
        bodies_(built, speed_m_per_s, carriage_m_per_s),
        brake_(settings_),
        reckoning_(settings_) {}

  [[nodiscard]] const bbmc::AxisConfiguration& settings() const { return settings_; }

  // A stiff law holds the motor's speed.
  void cruise(int length_ms) {
    constexpr double kStiff_Nm_s_per_rad = 3e-3;
    for (int i = 0; i < length_ms; ++i) {
      advance();
      torque_Nm_ = std::clamp(kStiff_Nm_s_per_rad * (speed_rad_per_s_ - bodies_.rotor_rad_per_s()),
                              -limit_Nm_, limit_Nm_);
    }
  }
  void skip(double way_m) { bodies_.skip(way_m / settings_.metres_per_motor_rad()); }

  // `obeys`: 1, or -1 for an amplifier that inverts.
  [[nodiscard]] Stop stop(bool told_of_end, double obeys = 1, double room_m = kYMaxRoom_m) {
    Stop result;
    brake_.begin(input(), false);
    if (told_of_end) {
      brake_.end_is_ahead(1, room_m * settings_.counts_per_m());
    }
    const double begun_rad = bodies_.carriage_rad();
    for (int ms = 0; ms < 500; ++ms) {
      const BrakeState state = brake_.update(input());
      if (state == BrakeState::kRanAway && !result.gave_up_ms) {
        result.gave_up_ms = ms;
      }
      torque_Nm_ = state == BrakeState::kBraking ? brake_.torque_Nm() : 0;
      result.torques_Nm.push_back(torque_Nm_);
      advance(obeys);
      result.furthest_m = std::max(result.furthest_m, (bodies_.carriage_rad() - begun_rad) *
                                                          settings_.metres_per_motor_rad());
    }
    return result;
  }

 private:
  void advance(double obeys = 1) {
    bodies_.advance(obeys * torque_Nm_);
    now_ns_ += kNanosecondsPerMillisecond;
    reckoning_.update(now_ns_, speed_count_per_s(), torque_Nm_, 1e-3);
  }
  [[nodiscard]] double speed_count_per_s() const {
    return bodies_.rotor_rad_per_s() / settings_.rad_per_count();
  }
  [[nodiscard]] bbmc::BrakeInput input() const {
    return {.now_ns = now_ns_,
            .speed_count_per_s = speed_count_per_s(),
            .momentum_count_per_s = reckoning_.momentum_count_per_s()};
  }

  bbmc::AxisConfiguration settings_;
  double speed_rad_per_s_;
  double limit_Nm_;
  TwoBodies bodies_;
  bbmc::Brake brake_;
  bbmc::DeadReckoning reckoning_;
  core::Nanoseconds now_ns_ = 0;
  double torque_Nm_ = 0;
};

// A carriage that is 0.28 m/s faster than its motor, nearly one swing later.
BrakedAxis swinging_axis() {
  BrakedAxis axis(0.5, 0.28);
  const double swing_ms = 1e3 / axis.settings().braking.held_motor_chain_Hz;
  axis.cruise(static_cast<int>(swing_ms) - 20);
  return axis;
}

TEST(EndAhead, ACarriageThatSwingsStopsBeforeTheHardEnd) {
  EXPECT_LT(swinging_axis().stop(true).furthest_m, kYMaxRoom_m);
  EXPECT_GT(swinging_axis().stop(false).furthest_m, kYMaxRoom_m) << "nothing to prevent";
}

// The switch is closed 2 ms late, and 2 ms pass until it is heard; a carriage on a chain a tenth
// softer, that carries a tenth more, then runs on 2.0 mm beyond its motor and touches.
TEST(EndAhead, WhereTheRoomIsShortTheMotorTurnsBack) {
  auto built = nominal_y();
  built.braking.held_motor_chain_Hz *= std::sqrt(0.9 / 1.1);
  constexpr double kSpeed_m_per_s = 0.057;
  constexpr double kLate_s = 4e-3;
  const double left_m = kYMinRoom_m - kLate_s * kSpeed_m_per_s;
  BrakedAxis told(kSpeed_m_per_s, 0, built);
  told.cruise(300);
  BrakedAxis untold(kSpeed_m_per_s, 0, built);
  untold.cruise(300);
  const double with_m = told.stop(true, 1, kYMinRoom_m).furthest_m;
  const double without_m = untold.stop(false).furthest_m;
  EXPECT_LT(with_m, 0.98 * left_m);
  EXPECT_GT(without_m, left_m) << "nothing to prevent";
}

TEST(EndAhead, ChangesNothingWhereTheWayIsLongEnough) {
  for (const double speed_m_per_s : {0.05, 0.2, 0.5}) {
    BrakedAxis told(speed_m_per_s, 0);
    told.cruise(300);
    BrakedAxis untold(speed_m_per_s, 0);
    untold.cruise(300);
    EXPECT_EQ(told.stop(true).torques_Nm, untold.stop(false).torques_Nm) << speed_m_per_s;
  }
}

TEST(ThrownMotor, IsNoDriveThatPushes) {
  BrakedAxis axis(0.2, 0);
  axis.cruise(300);
  axis.skip(-0.024);
  const Stop stop = axis.stop(true);
  EXPECT_FALSE(stop.gave_up_ms) << *stop.gave_up_ms;
  EXPECT_LT(stop.furthest_m, kYMaxRoom_m);
}

TEST(ThrownMotor, ADriveThatPushesIsGivenUp) {
  for (const double speed_m_per_s : {0.1, 0.3}) {
    BrakedAxis axis(speed_m_per_s, 0);
    axis.cruise(300);
    const Stop stop = axis.stop(true, -1);
    ASSERT_TRUE(stop.gave_up_ms);
    EXPECT_LT(*stop.gave_up_ms, 200);
    // By then it has not been made faster than running away is measured by.
    double pushed_Nm_s = 0;
    for (int ms = 0; ms < *stop.gave_up_ms; ++ms) {
      pushed_Nm_s += 1e-3 * std::fabs(stop.torques_Nm.at(static_cast<std::size_t>(ms)));
    }
    const auto& settings = axis.settings();
    EXPECT_LT(pushed_Nm_s / settings.braking.inertia_kg_m2 * settings.metres_per_motor_rad(),
              1.3 * (speed_m_per_s + 0.1));
  }
}

// The motor that swings may just turn round when the brake begins: the axis does not.
TEST(ThrownMotor, IsMeasuredByTheSpeedOfTheAxis) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[core::Axis::kY];
  bbmc::Brake brake(settings);
  bbmc::BrakeInput input{.speed_count_per_s = 1'000, .momentum_count_per_s = 90'000};
  brake.begin(input, false);
  input.speed_count_per_s = 100'000;
  (void)brake.update(input);
  EXPECT_LT(brake.torque_Nm(), 0);
}

}  // namespace
}  // namespace towbench::tests
