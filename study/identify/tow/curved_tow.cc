#include "study/identify/tow/curved_tow.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::harness::identify {
namespace {

using core::Axis;

constexpr double kAtSpeed = 0.98;  // of the path's highest speed

struct Row {
  core::PerAxis<double> velocity{};
  core::PerAxis<double> acceleration{};
  core::PerAxis<double> force_N{};
  double speed = 0;
  double turned_rad = 0;  // heading since the first row, not wrapped
};

std::size_t first_driven(const Recording& run) {
  std::size_t row = 1;
  while (row < run.rows() && (run.axes[Axis::kY].mode[row] != kFollowsReference ||
                              run.axes[Axis::kX].mode[row] != kFollowsReference)) {
    ++row;
  }
  return row;
}

// Heading from +Y, counter-clockwise seen from above: left of +Y is -X.
double heading_of(const core::PerAxis<double>& velocity) {
  return std::atan2(-velocity[Axis::kX], velocity[Axis::kY]);
}

std::vector<Row> rows_of(const Recording& with,
                         const core::PerAxis<std::span<const double>>& columns_with,
                         const Recording& without,
                         const core::PerAxis<std::span<const double>>& columns_without,
                         const core::PerAxis<double>& scale) {
  const std::size_t start = first_driven(with);
  const std::size_t other = first_driven(without);
  std::vector<Row> rows;
  for (std::size_t i = 0; start + i < with.rows() && other + i < without.rows(); ++i) {
    Row row;
    for (const auto axis : core::kAxes) {
      const auto& speed = with.axes[axis].reference_velocity_m_per_s;
      row.velocity[axis] = speed[start + i];
      row.acceleration[axis] = (speed[start + i] - speed[start + i - 1]) / with.period_s;
      row.force_N[axis] =
          scale[axis] * (columns_with[axis][start + i] - columns_without[axis][other + i]);
    }
    row.speed = std::hypot(row.velocity[Axis::kX], row.velocity[Axis::kY]);
    rows.push_back(row);
  }
  const auto fastest = std::max_element(
      rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.speed < b.speed; });
  if (fastest == rows.end()) {
    return rows;
  }
  const double at_speed = kAtSpeed * fastest->speed;
  std::erase_if(rows, [at_speed](const Row& row) { return row.speed < at_speed; });
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double step = heading_of(rows[i].velocity) - heading_of(rows[i - 1].velocity);
    rows[i].turned_rad = rows[i - 1].turned_rad + std::remainder(step, 2 * std::numbers::pi);
  }
  return rows;
}

// D, A, zero of Y, zero of X.
Eigen::Vector4d fit(std::span<const Row> turn, double slow_share) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const auto& row : turn) {
    for (const auto axis : core::kAxes) {
      if (std::fabs(row.velocity[axis]) < slow_share * row.speed) {
        continue;
      }
      const bool y = axis == Axis::kY;
      const Eigen::Vector4d a(row.speed * row.velocity[axis], row.acceleration[axis], y ? 1.0 : 0.0,
                              y ? 0.0 : 1.0);
      normal += a * a.transpose();
      right += a * row.force_N[axis];
    }
  }
  return normal.ldlt().solve(right);
}

struct Repeats {
  std::vector<double> along;
  std::vector<double> across;
};

// Means of one turn by heading, what the fit says of added mass and zeros taken off. Along and
// across the motion a round body's drag is constant, so the chain's swing can be averaged out
// first.
void add_headings(std::span<const Row> turn, const Eigen::Vector4d& solution, double period_s,
                  std::vector<Repeats>& repeats) {
  std::vector<double> along;
  std::vector<double> across;
  for (const auto& row : turn) {
    const double y = row.force_N[Axis::kY] - solution(1) * row.acceleration[Axis::kY] - solution(2);
    const double x = row.force_N[Axis::kX] - solution(1) * row.acceleration[Axis::kX] - solution(3);
    const double forward_y = row.velocity[Axis::kY] / row.speed;
    const double forward_x = row.velocity[Axis::kX] / row.speed;
    along.push_back(forward_y * y + forward_x * x);
    // Left of (forward_x, forward_y) is (-forward_y, forward_x); the force on the load is the
    // negative of (x, y), which is what the drive gives against it.
    across.push_back(forward_y * x - forward_x * y);
  }
  const auto swing = static_cast<std::size_t>(std::lround(kSwing_s / period_s));
  const auto quiet_along = without_swing(along, swing);
  const auto quiet_across = without_swing(across, swing);
  const std::size_t count = repeats.size();
  std::vector<Repeats> bins(count);
  for (std::size_t i = 0; i < quiet_along.size(); ++i) {
    const double wrapped = heading_of(turn[i + swing - 1].velocity) / (2 * std::numbers::pi) + 1.0;
    const auto bin = std::min(count - 1, static_cast<std::size_t>((wrapped - std::floor(wrapped)) *
                                                                  static_cast<double>(count)));
    bins[bin].along.push_back(quiet_along[i]);
    bins[bin].across.push_back(quiet_across[i]);
  }
  for (std::size_t bin = 0; bin < count; ++bin) {
    if (!bins[bin].along.empty()) {
      repeats[bin].along.push_back(mean_of_repeats(bins[bin].along).value);
      repeats[bin].across.push_back(mean_of_repeats(bins[bin].across).value);
    }
  }
}

}  // namespace

std::optional<CurvedDrag> curved_tow(const Recording& with,
                                     const core::PerAxis<std::span<const double>>& columns_with,
                                     const Recording& without,
                                     const core::PerAxis<std::span<const double>>& columns_without,
                                     const CurvedTowSettings& settings) {
  for (const auto axis : core::kAxes) {
    if (columns_with[axis].size() != with.rows() ||
        columns_without[axis].size() != without.rows()) {
      return std::nullopt;
    }
  }
  const auto rows = rows_of(with, columns_with, without, columns_without, settings.scale);
  std::vector<double> drags;
  std::vector<double> masses;
  std::vector<Repeats> repeats(settings.headings);
  CurvedDrag result;
  for (std::size_t first = 0; first < rows.size();) {
    const double start = rows[first].turned_rad;
    std::size_t last = first;
    while (last < rows.size() && std::fabs(rows[last].turned_rad - start) < 2 * std::numbers::pi) {
      ++last;
    }
    if (last == rows.size()) {
      break;  // not a whole turn
    }
    const std::span turn(rows.begin() + static_cast<std::ptrdiff_t>(first), last - first);
    const auto solution = fit(turn, settings.slow_share);
    drags.push_back(solution(0));
    masses.push_back(solution(1));
    add_headings(turn, solution, with.period_s, repeats);
    for (const auto& row : turn) {
      result.speed_m_per_s += row.speed / static_cast<double>(turn.size());
    }
    first = last;
  }
  result.turns = drags.size();
  if (result.turns < 2) {
    return std::nullopt;
  }
  result.speed_m_per_s /= static_cast<double>(result.turns);
  result.quadratic_drag_N_s2_per_m2 = mean_of_repeats(drags);
  result.added_mass_kg = mean_of_repeats(masses);
  for (std::size_t bin = 0; bin < settings.headings; ++bin) {
    const double middle = (static_cast<double>(bin) + 0.5) / static_cast<double>(settings.headings);
    result.headings.push_back({360.0 * middle, mean_of_repeats(repeats[bin].along),
                               mean_of_repeats(repeats[bin].across)});
  }
  return result;
}

}  // namespace towbench::harness::identify
