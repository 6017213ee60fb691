// Yaw, fin, curved path and sinusoid against signals with a known answer.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "study/identify/tow/curved_tow.h"
#include "study/identify/tow/drive_scale.h"
#include "study/identify/tow/sinusoidal_tow.h"
#include "study/identify/tow/spectral_line.h"
#include "study/identify/tow/yaw_drag.h"

namespace towbench::harness::identify {
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
  EXPECT_LT(line->frequency_Hz.deviation, 5e-4);
  EXPECT_GT(line->frequency_Hz.deviation, 1e-6);
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

// Y and X as given over time, with what the water does to them.
template <typename Motion>
Recording moving(Motion motion, double seconds, double drag, double mass) {
  Recording run;
  run.period_s = kPeriod_s;
  const auto rows = static_cast<std::size_t>(std::lround(seconds / kPeriod_s));
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * kPeriod_s;
    run.time_s.push_back(t);
    core::PerAxis<double> speed{};
    core::PerAxis<double> acceleration{};
    motion(t, speed, acceleration);
    const double total = std::hypot(speed[Axis::kY], speed[Axis::kX]);
    for (const auto axis : core::kAxes) {
      run.axes[axis].mode.push_back(2);
      run.axes[axis].reference_velocity_m_per_s.push_back(speed[axis]);
      run.force_N[axis].push_back(-drag * total * speed[axis] - mass * acceleration[axis] +
                                  (axis == Axis::kY ? 0.03 : -0.02));
    }
  }
  return run;
}

TEST(CurvedTow, FindsDragAsAVectorAlongACircle) {
  constexpr double kRate = kTurn / 4.0;
  const auto circle = [](double t, core::PerAxis<double>& v, core::PerAxis<double>& a) {
    v[Axis::kY] = 0.3 * std::sin(kRate * t);
    v[Axis::kX] = 0.3 * std::cos(kRate * t);
    a[Axis::kY] = 0.3 * kRate * std::cos(kRate * t);
    a[Axis::kX] = -0.3 * kRate * std::sin(kRate * t);
  };
  const auto in = moving(circle, 21.0, 8.78, 0.9);
  const auto out = moving(circle, 21.0, 0.0, 0.4);
  const auto drag =
      curved_tow(in, {{in.force_N[Axis::kY], in.force_N[Axis::kX]}}, out,
                 {{out.force_N[Axis::kY], out.force_N[Axis::kX]}}, {.scale = {{-1.0, -1.0}}});
  ASSERT_TRUE(drag);
  EXPECT_EQ(drag->turns, 5U);
  EXPECT_NEAR(drag->quadratic_drag_N_s2_per_m2.value, 8.78, 0.01);
  EXPECT_NEAR(drag->added_mass_kg.value, 0.5, 0.01);
  for (const auto& heading : drag->headings) {
    EXPECT_NEAR(heading.along_N.value, 8.78 * 0.09, 0.01);
    EXPECT_NEAR(heading.across_N.value, 0.0, 0.01);
  }
}

TEST(SinusoidalTow, FindsTheAddedMass) {
  constexpr double kRate = kTurn * 0.4;
  const auto swing = [](double t, core::PerAxis<double>& v, core::PerAxis<double>& a) {
    v[Axis::kY] = 0.35 * std::sin(kRate * t);
    a[Axis::kY] = 0.35 * kRate * std::cos(kRate * t);
  };
  const auto in = moving(swing, 25.0, 8.78, 0.9);
  const auto out = moving(swing, 25.0, 0.0, 0.4);
  const auto found = sinusoidal_tow(in, in.force_N[Axis::kY], out, out.force_N[Axis::kY], Axis::kY,
                                    {.scale = -1.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->added_mass_kg.value, 0.5, 0.005);
  EXPECT_NEAR(found->quadratic_drag_N_s2_per_m2.value, 8.78, 0.05);
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
}  // namespace towbench::harness::identify
