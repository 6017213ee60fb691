#include "study/identify/tow/drive_scale.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace towbench::study::identify {
namespace {

// Mean of pulled - plain over a stretch of time; both recordings have one row a period.
std::optional<UncertainMean> difference(const Recording& pulled, std::span<const double> a,
                                        const Recording& plain, std::span<const double> b,
                                        double from_s, double to_s) {
  const auto row = [](const Recording& recording, double time_s) {
    return static_cast<std::size_t>(
        std::lower_bound(recording.time_s.begin(), recording.time_s.end(), time_s) -
        recording.time_s.begin());
  };
  const std::size_t first_a = row(pulled, from_s);
  const std::size_t first_b = row(plain, from_s);
  const std::size_t rows = row(pulled, to_s) - first_a;
  if (first_a + rows > a.size() || first_b + rows > b.size() || rows == 0) {
    return std::nullopt;
  }
  std::vector<double> rest(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    rest[i] = a[first_a + i] - b[first_b + i];
  }
  return steady_mean(rest, pulled.period_s);
}

std::optional<UncertainMean> change(const Recording& pulled, std::span<const double> a,
                                    const Recording& plain, std::span<const double> b,
                                    const PullTimes& t) {
  const auto before = difference(pulled, a, plain, b, t.before_from_s, t.before_to_s);
  const auto after = difference(pulled, a, plain, b, t.pulled_from_s, t.pulled_to_s);
  if (!before || !after) {
    return std::nullopt;
  }
  return combine(1.0, *after, -1.0, *before);
}

}  // namespace

std::optional<DriveScale> drive_scale(const Recording& pulled, const Recording& plain,
                                      core::Axis axis, const PullTimes& times) {
  const auto force = change(pulled, pulled.force_N[axis], plain, plain.force_N[axis], times);
  const auto duty =
      change(pulled, pulled.axes[axis].duty_pct, plain, plain.axes[axis].duty_pct, times);
  constexpr double kClear = 10;  // standard deviations
  const auto is_clear = [](const UncertainMean& mean) {
    return std::fabs(mean.value) > kClear * mean.standard_error;
  };
  if (!force || !duty || !is_clear(*force) || !is_clear(*duty)) {
    return std::nullopt;
  }
  // The drive answers what the weight pulls: opposite signs.
  DriveScale scale{.force_per_duty_N = -force->value / duty->value};
  const auto relative = combine(1.0 / force->value, *force, 1.0 / duty->value, *duty);
  scale.standard_error_N = std::fabs(scale.force_per_duty_N) * relative.standard_error;
  scale.degrees_of_freedom = relative.degrees_of_freedom;
  return scale;
}

}  // namespace towbench::study::identify
