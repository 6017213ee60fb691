#include "study/diagnose/free_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kBins = 12;
constexpr int kPlaces = 4;
constexpr int kSpeeds = 5;
constexpr Index kWaves = 6;   // half waves over the stroke, at most
constexpr Index kPowers = 3;  // of the speed
constexpr double kMemories_s[] = {0.1, 0.2, 0.4, 0.8, 1.6, 3.2};  // of a part that gives way
constexpr double kWays[] = {0.02, 0.05, 0.1, 0.2, 0.4};           // of the stroke, after a reversal
constexpr double kTurnsBack = 0.002;       // of the stroke; less is no reversal
constexpr double kHeats_s[] = {1, 3, 10};  // of friction that its own work changes
constexpr Index kEach = 5;                 // of so many samples one is looked at
constexpr Index kFewestInCell = 50;        // samples of a cell

struct Coordinate {
  const char* name;
  VectorXd Motion::*of;
};
constexpr Coordinate kCoordinates[] = {{"position", &Motion::position_m},
                                       {"speed", &Motion::speed_m_per_s},
                                       {"acceleration", &Motion::acceleration_m_per_s2},
                                       {"command", &Motion::input_N},
                                       {"time", &Motion::time_s}};

// Edges of bins that hold as many samples each, the outer ones included.
std::vector<double> edges_of(const std::vector<Motion>& motions, VectorXd Motion::*of, int bins) {
  std::vector<double> values;
  for (const Motion& m : motions) {
    for (Index i = 0; i < (m.*of).size(); i += kEach) values.push_back((m.*of)[i]);
  }
  std::sort(values.begin(), values.end());
  std::vector<double> edges;
  for (int i = 0; i <= bins; ++i) {
    const double edge =
        values[(values.size() - 1) * static_cast<std::size_t>(i) / static_cast<std::size_t>(bins)];
    if (edges.empty() || edge > edges.back()) edges.push_back(edge);
  }
  return edges;
}

// Which bin a value lies in; outside all: in the outer one.
Index bin_of(const std::vector<double>& edges, double value) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return above - edges.begin() - 1;
}

std::optional<FreeShape> along(const Coordinate& coordinate, const std::vector<Motion>& motions) {
  const auto edges = edges_of(motions, coordinate.of, kBins);
  FreeShape shape{.coordinate = coordinate.name, .columns = std::ssize(edges) - 1};
  if (shape.columns < 3) return std::nullopt;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    shape.at.push_back(0.5 * (edges[i] + edges[i + 1]));
  }
  shape.force = [edges, of = coordinate.of](Index column, const Motion& m) -> VectorXd {
    return (m.*of).unaryExpr(
        [&](double value) { return bin_of(edges, value) == column ? 1.0 : 0.0; });
  };
  return shape;
}

// A grid; cells that the motion hardly enters are left out.
std::optional<FreeShape> along_place_and_speed(const std::vector<Motion>& motions) {
  const auto places = edges_of(motions, &Motion::position_m, kPlaces);
  const auto speeds = edges_of(motions, &Motion::speed_m_per_s, kSpeeds);
  const Index across = std::ssize(speeds) - 1;
  const auto cell_of = [places, speeds, across](const Motion& m, Index i) {
    return bin_of(places, m.position_m[i]) * across + bin_of(speeds, m.speed_m_per_s[i]);
  };
  if (places.size() < 3 || speeds.size() < 3) return std::nullopt;
  std::vector<Index> samples(static_cast<std::size_t>((std::ssize(places) - 1) * across));
  for (const Motion& m : motions) {
    for (Index i = 0; i < m.position_m.size(); ++i) {
      ++samples[static_cast<std::size_t>(cell_of(m, i))];
    }
  }
  std::vector<Index> cells;
  for (std::size_t cell = 0; cell < samples.size(); ++cell) {
    if (samples[cell] >= kFewestInCell) cells.push_back(static_cast<Index>(cell));
  }
  FreeShape shape{.coordinate = "position and speed", .columns = std::ssize(cells)};
  shape.force = [cells, cell_of](Index column, const Motion& m) {
    VectorXd force(m.position_m.size());
    for (Index i = 0; i < force.size(); ++i) {
      force[i] = cell_of(m, i) == cells[static_cast<std::size_t>(column)] ? 1.0 : 0.0;
    }
    return force;
  };
  return shape;
}

struct Range {
  double least_m;
  double most_m;
  [[nodiscard]] double stroke_m() const noexcept { return most_m - least_m; }
};
Range range_of(const std::vector<Motion>& motions) {
  Range range{motions.front().position_m[0], motions.front().position_m[0]};
  for (const Motion& m : motions) {
    range.least_m = std::min(range.least_m, m.position_m.minCoeff());
    range.most_m = std::max(range.most_m, m.position_m.maxCoeff());
  }
  return range;
}

double top_speed(const std::vector<Motion>& motions) {
  double top_m_per_s = 0;
  for (const Motion& m : motions) {
    top_m_per_s = std::max(top_m_per_s, m.speed_m_per_s.cwiseAbs().maxCoeff());
  }
  return top_m_per_s;
}

// Products of the slowest shapes of place and of powers of the speed: smooth in both, and finer
// over the place than the grid.
std::optional<FreeShape> smooth_in_place_and_speed(const std::vector<Motion>& motions) {
  const Range places = range_of(motions);
  const double top_m_per_s = top_speed(motions);
  if (places.stroke_m() <= 0 || top_m_per_s <= 0) return std::nullopt;
  FreeShape shape{
      .coordinate = "position times speed", .smooth = true, .columns = kWaves * kPowers};
  shape.force = [=](Index column, const Motion& m) -> VectorXd {
    const double per_m =
        std::numbers::pi * static_cast<double>(1 + column % kWaves) / places.stroke_m();
    const auto speed = (m.speed_m_per_s / top_m_per_s).array();
    return ((m.position_m.array() - places.least_m) * per_m).cos() *
           speed.pow(static_cast<double>(1 + column / kWaves));
  };
  return shape;
}

// A low pass of a signal, of time constant `memory_s`.
VectorXd low_pass(const VectorXd& signal, const Motion& m, double memory_s) {
  const double period_s =
      (m.time_s[m.time_s.size() - 1] - m.time_s[0]) / static_cast<double>(m.time_s.size() - 1);
  const double share = -std::expm1(-period_s / memory_s);
  VectorXd out(signal.size());
  double value = 0;
  for (Index i = 0; i < signal.size(); ++i) out[i] = value += share * (signal[i] - value);
  return out;
}

// Springs that creep (Maxwell).
FreeShape of_the_past(double top_m_per_s) {
  FreeShape shape{.coordinate = kMotionBefore, .columns = std::ssize(kMemories_s)};
  shape.force = [=](Index column, const Motion& m) {
    return low_pass(m.speed_m_per_s / top_m_per_s, m, kMemories_s[column]);
  };
  return shape;
}

// Dry friction that follows the heat of its own work.
FreeShape of_its_heat(double top_m_per_s) {
  FreeShape shape{.coordinate = "the work before", .columns = std::ssize(kHeats_s)};
  shape.force = [=](Index column, const Motion& m) -> VectorXd {
    constexpr double kTurns = 0.02;  // of top speed, over which friction turns over
    const VectorXd speed = m.speed_m_per_s / top_m_per_s;
    const VectorXd heat = low_pass(speed.cwiseAbs(), m, kHeats_s[column]);
    return heat.cwiseProduct((speed / kTurns).array().tanh().matrix());
  };
  return shape;
}

// Along the motion, and gone some way behind the place where it turned back.
VectorXd since_reversal(const Motion& m, double least_m, double fades_m) {
  VectorXd out(m.position_m.size());
  double turned_m = m.position_m[0];
  double farthest_m = turned_m;
  double direction = 0;
  for (Index i = 0; i < out.size(); ++i) {
    const double x = m.position_m[i];
    if (direction * (x - farthest_m) > 0) farthest_m = x;
    if (std::abs(x - farthest_m) > least_m) {
      turned_m = farthest_m;
      farthest_m = x;
      direction = x > turned_m ? 1 : -1;
    }
    out[i] = direction * std::exp(-std::abs(farthest_m - turned_m) / fades_m);
  }
  return out;
}

// Dry friction that each reversal changes.
std::optional<FreeShape> of_the_way_since(double stroke_m) {
  if (stroke_m <= 0) return std::nullopt;
  FreeShape shape{.coordinate = kWaySince, .columns = std::ssize(kWays)};
  shape.force = [=](Index column, const Motion& m) {
    return since_reversal(m, kTurnsBack * stroke_m, kWays[column] * stroke_m);
  };
  return shape;
}

}  // namespace

std::vector<FreeShape> free_shapes(const std::vector<Motion>& motions) {
  std::vector<FreeShape> shapes;
  for (const Coordinate& coordinate : kCoordinates) {
    if (auto shape = along(coordinate, motions)) shapes.push_back(std::move(*shape));
  }
  if (auto grid = along_place_and_speed(motions)) shapes.push_back(std::move(*grid));
  if (auto smooth = smooth_in_place_and_speed(motions)) shapes.push_back(std::move(*smooth));
  if (auto way = of_the_way_since(range_of(motions).stroke_m())) shapes.push_back(std::move(*way));
  shapes.push_back(of_the_past(top_speed(motions)));
  shapes.push_back(of_its_heat(top_speed(motions)));
  return shapes;
}

}  // namespace towbench::study::diagnose
