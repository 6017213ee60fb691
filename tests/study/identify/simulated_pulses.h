// Square-wave pulses of 0.4 s on Y, logged in counts.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "study/identify/output_error.h"
#include "study/identify/recording.h"

namespace towbench::study::identify {

inline Recording simulated_pulses(const emulator::AxisParameters& axis) {
  constexpr std::array<double, 8> kDuties_pct{12, 0, -12, 0, -12, 0, 12, 0};
  Recording data;
  data.period_s = 1e-3;
  data.rad_per_count[core::Axis::kY] = 2 * std::numbers::pi / 4000;
  data.metres_per_count[core::Axis::kY] =
      data.rad_per_count[core::Axis::kY] * axis.output_radius_m / axis.gear_ratio;
  auto& columns = data.axes[core::Axis::kY];
  for (std::size_t k = 0; k < 8000; ++k) {
    data.time_s.push_back(1e-3 * static_cast<double>(k));
    columns.duty_pct.push_back(k % 400 == 0 || columns.duty_pct.empty()
                                   ? kDuties_pct.at((k / 400) % kDuties_pct.size())
                                   : columns.duty_pct.back());
    columns.count.push_back(500000);
  }
  const auto counts = simulate_counts(axis, {}, data, core::Axis::kY).value();
  for (std::size_t k = 0; k < counts.size(); ++k) {
    columns.count[k] = static_cast<std::int64_t>(std::floor(counts[k]));
  }
  return data;
}

}  // namespace towbench::study::identify
