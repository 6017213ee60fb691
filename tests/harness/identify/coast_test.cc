// Coasts whose time constant is known in closed form.
#include "harness/identify/coast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::harness::identify {
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

TEST(Coast, WithoutASpanThereIsNoTimeConstant) {
  Recording data = coast(1.5, 9, 0);
  data.axes[core::Axis::kY].duty_pct.assign(data.rows(), 30.0);
  const auto spans = find_coasts(data, core::Axis::kY);
  EXPECT_TRUE(spans.empty());
  EXPECT_FALSE(fit_coasts(data, core::Axis::kY, spans, 1.5, 9).converged);
}

}  // namespace
}  // namespace towbench::harness::identify
