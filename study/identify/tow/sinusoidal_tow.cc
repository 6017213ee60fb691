#include "study/identify/tow/sinusoidal_tow.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

std::size_t first_moving(const Recording& run, core::Axis axis) {
  const auto& log = run.axes[axis];
  std::size_t row = 1;
  while (row < run.rows() &&
         !(log.mode[row] == kFollowsReference && log.reference_velocity_m_per_s[row] != 0)) {
    ++row;
  }
  return row;
}

// Rows at which the reference begins to move towards max.
std::vector<std::size_t> period_starts(const Recording& run, core::Axis axis, std::size_t first) {
  const auto& speed = run.axes[axis].reference_velocity_m_per_s;
  std::vector<std::size_t> starts;
  for (std::size_t i = first; i < run.rows(); ++i) {
    if (speed[i] > 0 && speed[i - 1] <= 0) {
      starts.push_back(i);
    }
  }
  return starts;
}

}  // namespace

std::optional<SinusoidalDrag> sinusoidal_force(const Recording& with, const Recording& without,
                                               core::Axis axis,
                                               const CarriageTransmission& transmission,
                                               std::size_t skip) {
  const std::size_t start = first_moving(with, axis);
  const std::size_t other = first_moving(without, axis);
  const auto starts = period_starts(with, axis, start);
  if (with.force_N[axis].size() != with.rows() || without.force_N[axis].size() != without.rows()) {
    return std::nullopt;
  }
  std::vector<double> masses;
  std::vector<double> drags;
  for (std::size_t k = skip; k + 1 + skip < starts.size(); ++k) {
    const TurnRows rows{starts[k], other + (starts[k] - start), starts[k + 1] - starts[k]};
    if (rows.first_out + rows.rows > without.rows()) {
      break;
    }
    const std::array turn{carriage_turn(with, without, rows, axis, transmission)};
    const auto found = water_forces(turn, with.period_s).front();
    masses.push_back(found.added_mass_kg);
    drags.push_back(found.drag_N_s2_per_m2);
  }
  if (masses.size() < 2) {
    return std::nullopt;
  }
  return SinusoidalDrag{.periods = masses.size(),
                        .added_mass_kg = mean_of_repeats(masses),
                        .quadratic_drag_N_s2_per_m2 = mean_of_repeats(drags)};
}

std::optional<SinusoidalDrag> sinusoidal_tow(const Recording& with,
                                             std::span<const double> column_with,
                                             const Recording& without,
                                             std::span<const double> column_without,
                                             core::Axis axis,
                                             const SinusoidalTowSettings& settings) {
  const std::size_t start = first_moving(with, axis);
  const std::size_t other = first_moving(without, axis);
  const auto starts = period_starts(with, axis, start);
  const auto& speed = with.axes[axis].reference_velocity_m_per_s;
  if (column_with.size() != with.rows() || column_without.size() != without.rows() ||
      starts.size() < 2 * settings.skip + 3) {
    return std::nullopt;
  }
  double fastest = 0;
  for (const double each : speed) {
    fastest = std::max(fastest, std::fabs(each));
  }
  std::vector<double> masses;
  std::vector<double> drags;
  for (std::size_t k = settings.skip; k + 1 + settings.skip < starts.size(); ++k) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = starts[k]; i < starts[k + 1]; ++i) {
      const std::size_t reference = other + (i - start);
      if (reference >= without.rows() || i + 1 >= with.rows() ||
          std::fabs(speed[i]) < settings.slow_share * fastest) {
        continue;
      }
      const double a = (speed[i + 1] - speed[i - 1]) / (2 * with.period_s);
      const Eigen::Vector3d row(a, std::fabs(speed[i]) * speed[i], 1.0);
      normal += row * row.transpose();
      right += row * (settings.scale * (column_with[i] - column_without[reference]));
    }
    const Eigen::Vector3d solution = solve_symmetric(normal, right);
    masses.push_back(solution(0));
    drags.push_back(solution(1));
  }
  return SinusoidalDrag{.periods = masses.size(),
                        .added_mass_kg = mean_of_repeats(masses),
                        .quadratic_drag_N_s2_per_m2 = mean_of_repeats(drags)};
}

}  // namespace towbench::study::identify
