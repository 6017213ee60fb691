// Coasts whose time constant is known in closed form.
#include "study/identify/coast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::study::identify {
namespace {

// Pushed at constant acceleration, then q = a + b t + c exp(-t/T) with a swing on top, in counts.
Recording coast(double time_constant_s, double swing_Hz, double swing_counts) {
  constexpr double kSpeed = 200e3;     // counts/s at the end of the push
  constexpr double kFriction = 150e3;  // counts/s^2, C/J
  constexpr std::size_t kPush = 200;
  Recording data;
  data.period_s = 1e-3;
  data.metres_per_count[core::Axis::kY] = 2e-6;
  auto& axis = data.axes[core::Axis::kY];
  const double rest = kFriction * time_constant_s;  // speed that friction takes in one T
  for (std::size_t k = 0; k < 2000; ++k) {
    data.time_s.push_back(static_cast<double>(k) * data.period_s);
    const double t = (static_cast<double>(k) - static_cast<double>(kPush)) * data.period_s;
    double count = 0;
    if (k < kPush) {
      const double s = data.time_s.back();
      count = 0.5 * kSpeed / (kPush * data.period_s) * s * s;
    } else {
      const double stop = time_constant_s * std::log(1 + kSpeed / rest);
      const double u = std::min(t, stop);
      count = 0.5 * kSpeed * kPush * data.period_s - rest * u +
              (kSpeed + rest) * time_constant_s * -std::expm1(-u / time_constant_s) +
              swing_counts * std::exp(-4 * t) * std::sin(2 * std::numbers::pi * swing_Hz * t);
    }
    axis.count.push_back(static_cast<std::int64_t>(std::floor(count)));
    axis.duty_pct.push_back(k < kPush ? 30.0 : 0.0);
  }
  return data;
}

TEST(Coast, TimeConstantOfACoastThatSwings) {
  for (const double time_constant_s : {0.5, 1.55, 3.0}) {
    const auto data = coast(time_constant_s, 9.7, 150);
    const auto spans = find_coasts(data, core::Axis::kY);
    ASSERT_EQ(spans.size(), 1U);
    const auto fit = fit_coasts(data, core::Axis::kY, spans, 1.2, 9.0);
    EXPECT_TRUE(fit.converged);
    EXPECT_NEAR(fit.time_constant_s / time_constant_s, 1, 0.02) << time_constant_s;
    EXPECT_NEAR(fit.swing_Hz, 9.7, 0.1);
    EXPECT_LT(fit.residual_rms_counts, 0.4);
  }
}

// The first fifth of a second of what looks like a coast is braked.
TEST(Coast, BeginsWhereTheMotorIsSlowEnough) {
  constexpr std::size_t kPush = 200;
  constexpr std::size_t kBraked = 200;
  constexpr double kCountsLost = 1e6;  // per s^2, while it is braked
  auto data = coast(1.55, 9.7, 150);
  auto& count = data.axes[core::Axis::kY].count;
  for (std::size_t k = kPush; k < data.rows(); ++k) {
    // As much further as it was faster before.
    const double t = static_cast<double>(k - kPush) * data.period_s;
    const double left_s = std::max(0.0, static_cast<double>(kBraked) * data.period_s - t);
    count[k] += static_cast<std::int64_t>(0.5 * kCountsLost * (0.04 - left_s * left_s));
  }
  const auto speed = [&](std::size_t k) {
    return static_cast<double>(count[k + 3] - count[k]) / 3e-3 * 2e-6;
  };
  const auto all = find_coasts(data, core::Axis::kY);
  const auto slow = find_coasts(data, core::Axis::kY, {.fastest_m_per_s = speed(kPush + kBraked)});
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(slow.size(), 1U);
  EXPECT_GE(slow[0].from, kPush + kBraked);
  EXPECT_LT(slow[0].from, kPush + kBraked + 150);  // the swing's next peak at the latest
  const auto error = [&](const std::vector<CoastSpan>& spans) {
    return std::fabs(fit_coasts(data, core::Axis::kY, spans, 1.2, 9.0).time_constant_s / 1.55 - 1);
  };
  EXPECT_LT(error(slow), 0.02);
  EXPECT_GT(error(all), 0.1);
}

TEST(Coast, WithoutASpanThereIsNoTimeConstant) {
  Recording data = coast(1.5, 9, 0);
  data.axes[core::Axis::kY].duty_pct.assign(data.rows(), 30.0);
  const auto spans = find_coasts(data, core::Axis::kY);
  EXPECT_TRUE(spans.empty());
  EXPECT_FALSE(fit_coasts(data, core::Axis::kY, spans, 1.5, 9).converged);
}

}  // namespace
}  // namespace towbench::study::identify
