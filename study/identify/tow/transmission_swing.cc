#include "study/identify/tow/transmission_swing.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/identify/linear_algebra.h"
#include "study/identify/secant_cost.h"

namespace towbench::study::identify {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Window {
  Eigen::VectorXd force_N;
  Eigen::VectorXd motor_m;  // about its own straight line
  double period_s = 0;
};

void take_line_off(Eigen::VectorXd& column) {
  const auto n = column.size();
  Eigen::MatrixX2d line(n, 2);
  line.col(0).setOnes();
  line.col(1) = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  const Eigen::Vector2d fit = solve_symmetric(line.transpose() * line, line.transpose() * column);
  column -= line * fit;
}

std::optional<Window> window_of(const Recording& run, core::Axis axis, double from_s, double to_s) {
  const auto row = [&](double time_s) {
    return std::lower_bound(run.time_s.begin(), run.time_s.end(), time_s) - run.time_s.begin();
  };
  const auto first = row(from_s);
  const auto rows = row(to_s) - first;
  constexpr std::ptrdiff_t kFewest = 200;
  if (rows < kFewest || run.force_N[axis].size() != run.rows()) {
    return std::nullopt;
  }
  Window window{Eigen::VectorXd(rows), Eigen::VectorXd(rows), run.period_s};
  for (std::ptrdiff_t i = 0; i < rows; ++i) {
    const auto at = static_cast<std::size_t>(first + i);
    window.force_N(i) = run.force_N[axis][at];
    window.motor_m(i) = run.position_m(axis, at);
  }
  take_line_off(window.motor_m);
  return window;
}

// Columns: the carriage's acceleration as x_m alone excites it, the free swing's, and a constant.
Eigen::MatrixX4d basis(const Window& window, double w, double d) {
  const auto rows = window.force_N.size();
  Eigen::MatrixX4d columns(rows, 4);
  // u = x' - d x_m, so that the motor's place is never differentiated. Trapezoidal rule:
  //   x' = u + d x_m    u' = w^2 (x_m - x) - d (u + d x_m)
  const double h = 0.5 * window.period_s;
  Eigen::Matrix2d a;
  a << 0.0, 1.0, -w * w, -d;
  const Eigen::Vector2d b(d, w * w - d * d);
  const Eigen::Matrix2d left = (Eigen::Matrix2d::Identity() - h * a).inverse();
  const Eigen::Matrix2d step = left * (Eigen::Matrix2d::Identity() + h * a);
  Eigen::Vector2d state(window.motor_m(0), -d * window.motor_m(0));
  const double swing = std::sqrt(std::max(w * w - 0.25 * d * d, 0.0));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double x_m = window.motor_m(i);
    if (i > 0) {
      state = step * state + left * (h * (window.motor_m(i - 1) + x_m)) * b;
    }
    const double t = static_cast<double>(i) * window.period_s;
    // x'' but for d x_m', which the trapezoid's difference has below.
    columns(i, 0) = w * w * (x_m - state(0)) - d * (state(1) + d * x_m);
    columns(i, 1) = std::exp(-0.5 * d * t) * std::cos(swing * t);
    columns(i, 2) = std::exp(-0.5 * d * t) * std::sin(swing * t);
    columns(i, 3) = 1.0;
  }
  for (Eigen::Index i = 1; i + 1 < rows; ++i) {
    columns(i, 0) += d * (window.motor_m(i + 1) - window.motor_m(i - 1)) / (4 * h);
  }
  return columns;
}

Eigen::VectorXd rest_of(const Window& window, double w, double d) {
  const auto columns = basis(window, w, d);
  const Eigen::Vector4d fit =
      solve_symmetric(columns.transpose() * columns, columns.transpose() * window.force_N);
  return window.force_N - columns * fit;
}

// The grid's best, from which the search begins.
double coarse_rate(const Window& window) {
  constexpr double kLowest_Hz = 1.5;
  constexpr double kHighest_Hz = 40.0;
  constexpr double kStep = 1.03;
  constexpr double kDamping = 0.06;
  double best = kTurn * kLowest_Hz;
  double least = window.force_N.squaredNorm();
  for (double f = kLowest_Hz; f < kHighest_Hz; f *= kStep) {
    const double w = kTurn * f;
    const double cost = rest_of(window, w, kDamping * w).squaredNorm();
    if (cost < least) {
      least = cost;
      best = w;
    }
  }
  return best;
}

}  // namespace

std::optional<TransmissionSwing> transmission_swing(const Recording& run, core::Axis axis,
                                                    double from_s, double to_s) {
  const auto window = window_of(run, axis, from_s, to_s);
  if (!window) {
    return std::nullopt;
  }
  const double coarse = coarse_rate(*window);
  Eigen::VectorXd p = Eigen::Vector2d(coarse, 0.06 * coarse);
  const auto residuals = [&](const double* at, double* rest) {
    Eigen::Map<Eigen::VectorXd>(rest, window->force_N.size()) = rest_of(*window, at[0], at[1]);
    return true;
  };
  SecantCost cost(residuals, static_cast<int>(window->force_N.size()),
                  {1e-4 * coarse, 1e-3 * coarse}, 0.0);
  const Search search{.bounds = {Eigen::Vector2d(0.8 * coarse, 1e-3 * coarse),
                                 Eigen::Vector2d(1.25 * coarse, coarse)}};
  std::string message;
  if (!minimise(cost, search, p, message)) {
    return std::nullopt;
  }
  const auto rows = window->force_N.size();
  const double variance = cost.residual().squaredNorm() / static_cast<double>(rows - 6);
  const Eigen::Vector2d centre(window->force_N.mean(), 0.0);
  constexpr double kSeen = 2.0;  // the swing leaves at most half of the scatter
  if ((window->force_N.array() - centre(0)).matrix().squaredNorm() <
      kSeen * cost.residual().squaredNorm()) {
    return std::nullopt;
  }
  const Eigen::Matrix2d covariance =
      variance * inverse(cost.jacobian().transpose() * cost.jacobian());
  return TransmissionSwing{p(0), std::sqrt(covariance(0, 0)), p(1)};
}

}  // namespace towbench::study::identify
