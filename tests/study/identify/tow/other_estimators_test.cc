// Yaw, fin, curved path and sinusoid against signals with a known answer.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "study/identify/tow/curved_tow.h"
#include "study/identify/tow/drive_scale.h"
#include "study/identify/tow/sinusoidal_tow.h"
#include "study/identify/tow/spectral_line.h"
#include "study/identify/tow/transmission_swing.h"
#include "study/identify/tow/yaw_drag.h"

namespace towbench::study::identify {
namespace {

using core::Axis;
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kPeriod_s = 1e-3;

std::vector<double> sine(double frequency_Hz, double amplitude, double mean, double noise,
                         std::size_t rows) {
  core::Random random(5);
  std::vector<double> samples;
  for (std::size_t i = 0; i < rows; ++i) {
    samples.push_back(
        mean +
        amplitude * std::sin(kTurn * frequency_Hz * static_cast<double>(i) * kPeriod_s + 0.7) +
        noise * random.gaussian());
  }
  return samples;
}

TEST(SpectralLine, FindsFrequencyAmplitudeAndMeanInNoise) {
  const auto samples = sine(2.137, 0.6, 0.4, 0.2, 30000);
  const auto line = strongest_line(samples, kPeriod_s, 0.2, 10.0);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->frequency_Hz.value, 2.137, 5e-4);
  EXPECT_LT(line->frequency_Hz.standard_error, 5e-4);
  EXPECT_GT(line->frequency_Hz.standard_error, 1e-6);
  EXPECT_NEAR(line->amplitude.value, 0.6, 0.01);
  EXPECT_NEAR(line->phase_turns, 0.7 / kTurn, 0.01);
  const auto mean = mean_over_periods(samples, kPeriod_s, line->frequency_Hz.value);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->value, 0.4, 0.01);
}

TEST(SpectralLine, SaysNothingOfARecordThatIsTooShort) {
  EXPECT_FALSE(strongest_line(sine(2.0, 1.0, 0.0, 0.0, 3000), kPeriod_s, 0.2, 10.0));
  EXPECT_FALSE(mean_over_periods(sine(2.0, 1.0, 0.0, 0.0, 900), kPeriod_s, 2.0));
}

TEST(YawDrag, TellsDragAlongAndAcrossTheBodyApart) {
  std::vector<YawPoint> points;
  for (const double yaw : {0.0, 20.0, 45.0, 90.0}) {
    const double b = yaw * std::numbers::pi / 180;
    points.push_back({yaw,
                      {2.0 * std::pow(std::cos(b), 2) + 12.0 * std::pow(std::sin(b), 2), 0.01, 20},
                      {10.0 * std::sin(b) * std::cos(b), 0.01, 20}});
  }
  const auto law = yaw_drag(points);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->along_axis.value, 2.0, 1e-9);
  EXPECT_NEAR(law->ratio.value, 6.0, 1e-9);
  EXPECT_NEAR(law->along_at(30.0), 2.0 * 0.75 + 12.0 * 0.25, 1e-9);
  EXPECT_FALSE(yaw_drag(std::span(points).first(1))) << "one angle along the axis says nothing";
}

// The carriage on a transmission of its own, integrated by Runge and Kutta: what the force sensor
// below it feels while a motor goes round a circle or to and fro. Friction turns round with the
// carriage.
struct Towed {
  double transmission_rad_per_s = 25.9;
  double mass_kg = 6.6;
  double friction_N = 1.7;
  double load_kg = 0.4;
  double added_kg = 0;
  double drag = 0;
};

class TransmissionedCarriage {
 public:
  explicit TransmissionedCarriage(const Towed& towed) : t_(towed) {}

  // `motor`: place and speed; `across`: the other axis's speed, for |v|. Returns the force.
  template <typename Motor>
  double step(double time_s, const Motor& motor, double across) {
    const auto rates = [&](double time, const std::array<double, 2>& s) {
      const auto [place, speed] = motor(time);
      const double k = t_.mass_kg * t_.transmission_rad_per_s * t_.transmission_rad_per_s;
      const double c = 0.05 * t_.mass_kg * t_.transmission_rad_per_s;
      const double force = k * (place - s[0]) + c * (speed - s[1]) -
                           t_.friction_N * std::tanh(s[1] / 1e-3) -
                           t_.drag * std::hypot(s[1], across) * s[1];
      return std::array<double, 2>{s[1], force / (t_.mass_kg + t_.added_kg)};
    };
    const auto at = [&](const std::array<double, 2>& k, double share) {
      return std::array<double, 2>{state_[0] + share * kPeriod_s * k[0],
                                   state_[1] + share * kPeriod_s * k[1]};
    };
    const auto a = rates(time_s, state_);
    const auto b = rates(time_s + 0.5 * kPeriod_s, at(a, 0.5));
    const auto c = rates(time_s + 0.5 * kPeriod_s, at(b, 0.5));
    const auto d = rates(time_s + kPeriod_s, at(c, 1.0));
    for (std::size_t i = 0; i < 2; ++i) {
      state_.at(i) += kPeriod_s / 6 * (a.at(i) + 2 * b.at(i) + 2 * c.at(i) + d.at(i));
    }
    const auto now = rates(time_s + kPeriod_s, state_);
    return -t_.drag * std::hypot(state_[1], across) * state_[1] -
           (t_.load_kg + t_.added_kg) * now[1];
  }

 private:
  Towed t_;
  std::array<double, 2> state_{};
};

void add_row(Recording& run, core::Axis axis, double place, double speed, double force) {
  auto& log = run.axes[axis];
  log.mode.push_back(kFollowsReference);
  log.reference_m.push_back(place);
  log.reference_velocity_m_per_s.push_back(speed);
  log.count.push_back(static_cast<std::int64_t>(std::floor(place / run.metres_per_count[axis])));
  run.force_N[axis].push_back(force);
}

Recording empty_recording() {
  Recording run;
  run.period_s = kPeriod_s;
  run.metres_per_count = {{2.2e-6, 2.2e-6}};
  return run;
}

// 0.2 m about, a turn in 4 s: the carriage of Y goes 0.37 % further than its motor.
Recording circle(const Towed& y, const Towed& x, double seconds, std::uint64_t seed) {
  constexpr double kRate = kTurn / 4.0;
  constexpr double kRadius = 0.2;
  core::Random random(seed);
  auto run = empty_recording();
  TransmissionedCarriage along(y);
  TransmissionedCarriage across(x);
  const auto motor_y = [](double t) {
    return std::pair{-kRadius * (std::cos(kRate * t) - 1), kRadius * kRate * std::sin(kRate * t)};
  };
  const auto motor_x = [](double t) {
    return std::pair{kRadius * std::sin(kRate * t), kRadius * kRate * std::cos(kRate * t)};
  };
  const auto rows = static_cast<std::size_t>(std::lround(seconds / kPeriod_s));
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * kPeriod_s;
    const double next = t + kPeriod_s;
    run.time_s.push_back(next);
    const double force_y = along.step(t, motor_y, motor_x(t).second);
    const double force_x = across.step(t, motor_x, motor_y(t).second);
    add_row(run, Axis::kY, motor_y(next).first, motor_y(next).second,
            force_y + 0.03 + 0.02 * random.gaussian());
    add_row(run, Axis::kX, motor_x(next).first, motor_x(next).second,
            force_x - 0.02 + 0.02 * random.gaussian());
  }
  return run;
}

constexpr Towed kStiff{.transmission_rad_per_s = 111, .mass_kg = 0.95, .friction_N = 1.2};

Towed in_water(Towed dry) {
  dry.added_kg = 0.5;
  dry.drag = 8.78;
  return dry;
}

core::PerPlanarAxis<CarriageTransmission> transmissions(double y_rad_per_s, double x_rad_per_s) {
  core::PerPlanarAxis<CarriageTransmission> transmission;
  transmission[Axis::kY] = {.rate_rad_per_s = y_rad_per_s, .mass_kg = 6.6};
  transmission[Axis::kX] = {.rate_rad_per_s = x_rad_per_s, .mass_kg = 0.95};
  return transmission;
}

TEST(CurvedForce, KnowsThatTheCarriageGoesFurtherThanItsMotor) {
  const auto out = circle({}, kStiff, 38.0, 1);
  const auto in = circle(in_water({}), in_water(kStiff), 38.0, 2);
  const auto transmission = transmissions(25.9, 111);
  const auto drag = curved_force(in, out, transmission);
  ASSERT_TRUE(drag);
  EXPECT_EQ(drag->turns, 8U);
  EXPECT_NEAR(drag->quadratic_drag_N_s2_per_m2.value, 8.78, 0.002 * 8.78);
  EXPECT_GT(drag->quadratic_drag_N_s2_per_m2.standard_error, 1e-4);
  for (const auto axis : core::kPlanarAxes) {
    EXPECT_NEAR(drag->along_axis_N_s2_per_m2[axis].value, 8.78, 0.003 * 8.78);
  }
  EXPECT_NEAR(drag->added_mass_kg.value, 0.5, 0.01);
  // A motor taken for the carriage: the drag of Y comes out too high.
  const auto rigid = transmissions(1e4, 1e4);
  const auto blind = curved_force(in, out, rigid);
  ASSERT_TRUE(blind);
  EXPECT_GT(blind->along_axis_N_s2_per_m2[Axis::kY].value, 1.004 * 8.78);
  EXPECT_FALSE(curved_force(in, circle({}, kStiff, 9.0, 3), transmission))
      << "one turn is no repeat";
}

Recording swing(const Towed& towed, double frequency_Hz, std::uint64_t seed) {
  const double rate = kTurn * frequency_Hz;
  core::Random random(seed);
  auto run = empty_recording();
  TransmissionedCarriage carriage(towed);
  const auto motor = [rate](double t) {
    return std::pair{-0.15 * (std::cos(rate * t) - 1), 0.15 * rate * std::sin(rate * t)};
  };
  const auto rows = static_cast<std::size_t>(std::lround(10.0 / frequency_Hz / kPeriod_s));
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * kPeriod_s;
    run.time_s.push_back(t + kPeriod_s);
    const double force = carriage.step(t, motor, 0.0) + 0.03 + 0.02 * random.gaussian();
    const auto [place, speed] = motor(t + kPeriod_s);
    add_row(run, Axis::kY, place, speed, force);
  }
  return run;
}

TEST(SinusoidalForce, FindsDragAndAddedMassBehindATransmission) {
  const CarriageTransmission transmission{.rate_rad_per_s = 25.9, .mass_kg = 6.6};
  const auto in = swing(in_water({}), 0.46, 4);
  const auto out = swing({}, 0.46, 5);
  const auto found = sinusoidal_force(in, out, Axis::kY, transmission, 2);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->added_mass_kg.value, 0.5, 0.005);
  EXPECT_NEAR(found->quadratic_drag_N_s2_per_m2.value, 8.78, 0.004 * 8.78);
  const auto blind =
      sinusoidal_force(in, out, Axis::kY, {.rate_rad_per_s = 1e4, .mass_kg = 6.6}, 2);
  ASSERT_TRUE(blind);
  EXPECT_GT(blind->quadratic_drag_N_s2_per_m2.value, 1.015 * 8.78);
}

// A weight sets in while the motor gives way and comes back.
TEST(TransmissionSwing, IsThatOfAHeldMotorThoughTheMotorGivesWay) {
  core::Random random(6);
  auto run = empty_recording();
  double place = 0;
  double speed = 0;
  constexpr double kRate = 25.9;
  constexpr double kDamping = 1.4;
  const auto motor = [](double t) { return -7e-4 * std::exp(-4 * t) * std::sin(20 * t); };
  for (int i = 0; i < 2000; ++i) {
    constexpr int kFine = 20;
    double acceleration = 0;
    for (int fine = 0; fine < kFine; ++fine) {
      const double h = kPeriod_s / kFine;
      const double t = i * kPeriod_s + fine * h;
      const double motor_speed = (motor(t + h) - motor(t)) / h;
      acceleration =
          kRate * kRate * (motor(t) - place) + kDamping * (motor_speed - speed) - 16.0 / 6.6;
      speed += h * acceleration;
      place += h * speed;
    }
    const double now = (i + 1) * kPeriod_s;
    run.time_s.push_back(now);
    add_row(run, Axis::kY, motor(now), 0, -16.0 - 0.4 * acceleration + 0.02 * random.gaussian());
  }
  const auto found = transmission_swing(run, Axis::kY, 0.03, 2.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->rate_rad_per_s, kRate, 0.1);
  EXPECT_NEAR(found->rate_rad_per_s, kRate, 4 * found->standard_error);
  EXPECT_LT(found->standard_error, 0.1);
  EXPECT_FALSE(transmission_swing(run, Axis::kY, 1.9, 2.5)) << "too short";
}

TEST(YawDrag, KnowsThatAllAnglesShareTheRunsOutOfTheWater) {
  std::vector<YawPoint> points;
  for (const double yaw : {0.0, 20.0, 45.0, 90.0}) {
    const double b = yaw * std::numbers::pi / 180;
    points.push_back({yaw,
                      {2.0 * std::pow(std::cos(b), 2) + 12.0 * std::pow(std::sin(b), 2), 0.01, 20},
                      {10.0 * std::sin(b) * std::cos(b), 0.01, 20}});
  }
  const auto apart = yaw_drag(points);
  const auto shared = yaw_drag(points, {.along = 0.008, .side = 0.008});
  ASSERT_TRUE(apart && shared);
  EXPECT_GT(shared->along_axis.standard_error, 1.1 * apart->along_axis.standard_error);
  EXPECT_LT(shared->along_axis.standard_error, 0.012);
}

TEST(DriveScale, IsTheWeightOverTheChangeOfDuty) {
  Recording plain;
  plain.period_s = kPeriod_s;
  for (int i = 0; i < 8000; ++i) {
    plain.time_s.push_back(i * kPeriod_s);
    plain.force_N[Axis::kY].push_back(0.02);
    plain.axes[Axis::kY].duty_pct.push_back(5.0 + 1e-4 * i);
  }
  auto pulled = plain;
  for (std::size_t i = 4000; i < 8000; ++i) {
    pulled.force_N[Axis::kY][i] -= 8.0;
    pulled.axes[Axis::kY].duty_pct[i] += 8.0 / 0.69;
  }
  const PullTimes times{1.0, 3.5, 4.5, 7.5};
  const auto scale = drive_scale(pulled, plain, Axis::kY, times);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(scale->force_per_duty_N, 0.69, 1e-9);
  EXPECT_FALSE(drive_scale(plain, plain, Axis::kY, times)) << "no weight, no scale";
}

}  // namespace
}  // namespace towbench::study::identify
