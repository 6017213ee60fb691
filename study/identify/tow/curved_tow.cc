#include "study/identify/tow/curved_tow.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

using core::Axis;

constexpr double kAtSpeed = 0.98;  // of the path's highest speed

struct Row {
  core::PerPlanarAxis<double> velocity{};  // of the reference
  core::PerPlanarAxis<double> acceleration{};
  core::PerPlanarAxis<double> force_N{};  // what the water adds, by the columns
  double speed = 0;
  double turned_rad = 0;  // heading since the first row, not wrapped
  std::size_t row_with = 0;
  std::size_t row_without = 0;
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
double heading_of(const core::PerPlanarAxis<double>& velocity) {
  return std::atan2(-velocity[Axis::kX], velocity[Axis::kY]);
}

std::vector<Row> rows_of(const Recording& with,
                         const core::PerPlanarAxis<std::span<const double>>& columns_with,
                         const Recording& without,
                         const core::PerPlanarAxis<std::span<const double>>& columns_without,
                         const core::PerPlanarAxis<double>& scale) {
  const std::size_t start = first_driven(with);
  const std::size_t other = first_driven(without);
  std::vector<Row> rows;
  for (std::size_t i = 0; start + i < with.rows() && other + i < without.rows(); ++i) {
    Row row{.row_with = start + i, .row_without = other + i};
    for (const auto axis : core::kPlanarAxes) {
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

// Rows of whole turns, but for the first: the carriage still swings from where the motion began.
std::vector<std::span<const Row>> turns_of(const std::vector<Row>& rows) {
  std::vector<std::span<const Row>> turns;
  for (std::size_t first = 0; first < rows.size();) {
    const double start = rows[first].turned_rad;
    std::size_t last = first;
    while (last < rows.size() && std::fabs(rows[last].turned_rad - start) < 2 * std::numbers::pi) {
      ++last;
    }
    if (last == rows.size()) {
      break;
    }
    turns.push_back(std::span(rows).subspan(first, last - first));
    first = last;
  }
  if (!turns.empty()) {
    turns.erase(turns.begin());
  }
  return turns;
}

// D, A, zero of Y, zero of X.
Eigen::Vector4d fit(std::span<const Row> turn, double slow_share) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const auto& row : turn) {
    for (const auto axis : core::kPlanarAxes) {
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
  return solve_symmetric(normal, right);
}

struct Repeats {
  std::vector<double> along;  // against the motion, over the carriage's speed squared
  std::vector<double> across;
};

// One turn of both axes, Y first as in core::kPlanarAxes.
struct Turn {
  std::vector<CarriageTurn> carriage;
  std::vector<WaterForce> water;
  std::vector<double> speeds;
  double added_mass_kg = 0;
};

Turn turn_of(std::span<const Row> rows, const Recording& with, const Recording& without,
             const core::PerPlanarAxis<CarriageTransmission>& transmission) {
  Turn turn;
  for (const auto axis : core::kPlanarAxes) {
    turn.carriage.push_back(
        carriage_turn(with, without, {rows.front().row_with, rows.front().row_without, rows.size()},
                      axis, transmission[axis]));
  }
  turn.water = water_forces(turn.carriage, with.period_s);
  turn.speeds = speeds_of(turn.water);
  for (const auto& water : turn.water) {
    turn.added_mass_kg += water.added_mass_kg / static_cast<double>(turn.water.size());
  }
  return turn;
}

// Along and across the motion a round body's drag is constant, so the transmission's swing can be
// averaged out, of the force and of the speeds alike. What the carriage's acceleration needs, the
// run out of the water shows.
void add_headings(std::span<const Row> rows, const Turn& turn, const Recording& with,
                  const Recording& without, std::vector<Repeats>& repeats) {
  std::array<std::vector<double>, 3> columns;  // along, across, |v| v along
  std::vector<double> headings;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    core::PerPlanarAxis<double> drag{};
    core::PerPlanarAxis<double> sine{};
    core::PerPlanarAxis<double> square{};
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(rows.size());
    std::size_t k = 0;
    for (const auto axis : core::kPlanarAxes) {
      const auto& t = turn.carriage[k];
      drag[axis] = t.force_in_N.mean - t.force_N[i] -
                   t.inertial_N(i, without.force_N[axis][rows[i].row_without],
                                t.mass_out_kg + turn.added_mass_kg);
      square[axis] = turn.speeds[i] * turn.water[k++].velocity_m_per_s[i];
      sine[axis] = std::real(std::complex<double>(0.0, t.rate_rad_per_s) * t.place_m *
                             std::polar(1.0, angle));
    }
    const double speed = std::hypot(sine[Axis::kX], sine[Axis::kY]);
    const double y = sine[Axis::kY] / speed;
    const double x = sine[Axis::kX] / speed;
    columns[0].push_back(y * drag[Axis::kY] + x * drag[Axis::kX]);
    // Left of (x, y) is (-y, x); the force on the load is the negative of `drag`.
    columns[1].push_back(y * drag[Axis::kX] - x * drag[Axis::kY]);
    columns[2].push_back(y * square[Axis::kY] + x * square[Axis::kX]);
    headings.push_back(heading_of(sine) / (2 * std::numbers::pi) + 1.0);
  }
  const auto swing = static_cast<std::size_t>(std::lround(kSwing_s / with.period_s));
  for (auto& column : columns) {
    column = without_swing(column, swing);
  }
  const std::size_t count = repeats.size();
  std::vector<std::array<double, 3>> sums(count);
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    const double wrapped = headings[i + swing - 1];
    const auto bin = std::min(count - 1, static_cast<std::size_t>((wrapped - std::floor(wrapped)) *
                                                                  static_cast<double>(count)));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      sums[bin][c] += columns[c][i];
    }
  }
  for (std::size_t bin = 0; bin < count; ++bin) {
    if (sums[bin][2] > 0) {
      repeats[bin].along.push_back(sums[bin][0] / sums[bin][2]);
      repeats[bin].across.push_back(sums[bin][1] / sums[bin][2]);
    }
  }
}

bool has_forces(const Recording& run) {
  return run.force_N[Axis::kY].size() == run.rows() && run.force_N[Axis::kX].size() == run.rows();
}

}  // namespace

std::optional<CurvedDrag> curved_drive(const Recording& with, const Recording& without,
                                       const CurvedDriveSettings& settings) {
  const auto duty = [](const Recording& run) {
    return core::PerPlanarAxis<std::span<const double>>{
        {run.axes[Axis::kY].duty_pct, run.axes[Axis::kX].duty_pct}};
  };
  const auto rows = rows_of(with, duty(with), without, duty(without), settings.scale);
  std::vector<double> drags;
  std::vector<double> masses;
  for (const auto& turn : turns_of(rows)) {
    const auto solution = fit(turn, settings.slow_share);
    drags.push_back(solution(0));
    masses.push_back(solution(1));
  }
  if (drags.size() < 2) {
    return std::nullopt;
  }
  return CurvedDrag{.turns = drags.size(),
                    .quadratic_drag_N_s2_per_m2 = mean_of_repeats(drags),
                    .added_mass_kg = mean_of_repeats(masses)};
}

std::optional<CurvedDrag> curved_force(
    const Recording& with, const Recording& without,
    const core::PerPlanarAxis<CarriageTransmission>& transmission, std::size_t headings) {
  if (!has_forces(with) || !has_forces(without)) {
    return std::nullopt;
  }
  const auto force = [](const Recording& run) {
    return core::PerPlanarAxis<std::span<const double>>{
        {run.force_N[Axis::kY], run.force_N[Axis::kX]}};
  };
  const auto rows = rows_of(with, force(with), without, force(without), {{-1.0, -1.0}});
  const auto turns = turns_of(rows);
  if (turns.size() < 2) {
    return std::nullopt;
  }
  CurvedDrag result{.turns = turns.size()};
  std::vector<double> drags;
  core::PerPlanarAxis<std::vector<double>> along;
  std::vector<double> masses;
  std::vector<Repeats> repeats(headings);
  const double share = 1.0 / static_cast<double>(turns.size());
  double rate_rad_per_s = 0;
  for (const auto& rows_of_turn : turns) {
    const auto turn = turn_of(rows_of_turn, with, without, transmission);
    drags.push_back(0.5 * (turn.water[0].drag_N_s2_per_m2 + turn.water[1].drag_N_s2_per_m2));
    masses.push_back(turn.added_mass_kg);
    add_headings(rows_of_turn, turn, with, without, repeats);
    result.speed_m_per_s += share * mean_of_repeats(turn.speeds).value;
    rate_rad_per_s = turn.carriage.front().rate_rad_per_s;
    along[Axis::kY].push_back(turn.water[0].drag_N_s2_per_m2);
    along[Axis::kX].push_back(turn.water[1].drag_N_s2_per_m2);
  }
  double all_doubt = 0;
  for (const auto axis : core::kPlanarAxes) {
    const double doubt = doubt_by_transmission(transmission[axis], rate_rad_per_s);
    result.along_axis_N_s2_per_m2[axis] =
        doubted(mean_of_repeats(along[axis]), doubt, kTransmissionDegreesOfFreedom);
    all_doubt = std::hypot(all_doubt, 0.5 * doubt);  // each axis has half of the drag
  }
  result.quadratic_drag_N_s2_per_m2 =
      doubted(mean_of_repeats(drags), all_doubt, kTransmissionDegreesOfFreedom);
  result.added_mass_kg = mean_of_repeats(masses);
  for (std::size_t bin = 0; bin < headings; ++bin) {
    const double middle = (static_cast<double>(bin) + 0.5) / static_cast<double>(headings);
    result.headings.push_back({360.0 * middle, mean_of_repeats(repeats[bin].along),
                               mean_of_repeats(repeats[bin].across)});
  }
  return result;
}

}  // namespace towbench::study::identify
