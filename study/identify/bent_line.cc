#include "study/identify/bent_line.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

struct Solved {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
  double square = 0;  // weighted
};

// Weighted least squares of the values at given knots; hats between them.
Solved solve(const std::vector<LinePoint>& points, const std::vector<double>& knots,
             bool with_covariance = false) {
  const auto n = static_cast<Eigen::Index>(points.size());
  const auto m = static_cast<Eigen::Index>(knots.size());
  Eigen::MatrixXd hats = Eigen::MatrixXd::Zero(n, m);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, point.x);
    const auto k = static_cast<Eigen::Index>(above - knots.begin());
    const double share = (point.x - *(above - 1)) / (*above - *(above - 1));
    hats(i, k - 1) = (1 - share) / point.standard_error;
    hats(i, k) = share / point.standard_error;
    y[i] = point.y / point.standard_error;
  }
  Solved solved;
  // The least-norm solution where a piece has no point of its own.
  solved.values = least_norm_solution(hats, y);
  solved.square = (y - hats * solved.values).squaredNorm();
  if (with_covariance) {
    solved.covariance = pseudo_inverse(hats.transpose() * hats);
  }
  return solved;
}

double criterion(double square, std::size_t points, std::size_t bends) {
  const auto n = static_cast<double>(points);
  return n * std::log(std::max(square, 1e-12 * n) / n) +
         2 * static_cast<double>(bends) * std::log(n);
}

// Moves one knot to the best place between its neighbours, by golden section.
void settle(const std::vector<LinePoint>& points, std::vector<double>& knots, std::size_t i,
            double margin) {
  constexpr double kGolden = 0.6180339887498949;
  double low = knots[i - 1] + margin;
  double high = knots[i + 1] - margin;
  const auto left = [&](double place) {
    knots[i] = place;
    return solve(points, knots).square;
  };
  for (int step = 0; step < 25 && low < high; ++step) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    if (left(a) < left(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  knots[i] = 0.5 * (low + high);
}

std::vector<double> with_best_bend(const std::vector<LinePoint>& points,
                                   const std::vector<double>& knots, double margin) {
  std::vector<double> best;
  double least = 0;
  for (const auto& point : points) {
    const auto above = std::upper_bound(knots.begin(), knots.end(), point.x);
    if (above == knots.begin() || above == knots.end() || *above - point.x < margin ||
        point.x - *(above - 1) < margin) {
      continue;
    }
    auto tried = knots;
    tried.insert(tried.begin() + (above - knots.begin()), point.x);
    const double square = solve(points, tried).square;
    if (best.empty() || square < least) {
      best = std::move(tried);
      least = square;
    }
  }
  for (int sweep = 0; sweep < 2 && !best.empty(); ++sweep) {
    for (std::size_t i = 1; i + 1 < best.size(); ++i) {
      settle(points, best, i, 0.5 * margin);
    }
  }
  return best;
}

}  // namespace

double BentLine::at(double place) const noexcept {
  if (x.empty()) {
    return 0;
  }
  if (place <= x.front()) {
    return y.front();
  }
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (place <= x[i]) {
      return y[i - 1] + (y[i] - y[i - 1]) * (place - x[i - 1]) / (x[i] - x[i - 1]);
    }
  }
  return y.back();
}

BentLine fit_bent_line(std::vector<LinePoint> points, int most_bends) {
  BentLine line;
  if (points.size() < 6) {
    return line;
  }
  std::sort(points.begin(), points.end(),
            [](const LinePoint& a, const LinePoint& b) { return a.x < b.x; });
  const double length = points.back().x - points.front().x;
  if (!(length > 0)) {
    return line;
  }
  const double margin = 3 * length / static_cast<double>(points.size());
  std::vector<double> knots{points.front().x, points.back().x};
  double best = criterion(solve(points, knots).square, points.size(), 0);
  for (int bends = 1; bends <= most_bends; ++bends) {
    const auto more = with_best_bend(points, knots, margin);
    if (more.empty()) {
      break;
    }
    const double value =
        criterion(solve(points, more).square, points.size(), static_cast<std::size_t>(bends));
    if (value >= best) {
      break;
    }
    best = value;
    knots = more;
  }
  const auto solved = solve(points, knots, true);
  const double degrees_of_freedom =
      std::max(1.0, static_cast<double>(points.size()) - static_cast<double>(knots.size()));
  const double unit = solved.square / degrees_of_freedom;
  line.x = knots;
  for (Eigen::Index i = 0; i < solved.values.size(); ++i) {
    line.y.push_back(solved.values[i]);
    line.standard_error.push_back(std::sqrt(unit * solved.covariance(i, i)));
  }
  double square = 0;
  for (const auto& point : points) {
    square += (point.y - line.at(point.x)) * (point.y - line.at(point.x));
  }
  line.residual_rms = std::sqrt(square / static_cast<double>(points.size()));
  return line;
}

}  // namespace towbench::study::identify
