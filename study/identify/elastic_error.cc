#include "study/identify/elastic_error.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "study/identify/linear_algebra.h"
#include "study/statistics/statistics.h"

namespace towbench::study::identify {
namespace {

constexpr std::size_t kFewestFrames = 30;

// Linear between rows; NaN outside.
double interpolated(const std::vector<double>& time_s, const std::vector<double>& values,
                    double when_s) {
  const auto after = std::lower_bound(time_s.begin(), time_s.end(), when_s);
  if (after == time_s.begin() || after == time_s.end()) {
    return NAN;
  }
  const auto k = static_cast<std::size_t>(after - time_s.begin());
  const double share = (when_s - time_s[k - 1]) / (time_s[k] - time_s[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

struct StretchProblem {
  std::vector<double> when_s;
  Eigen::MatrixXd regressors;  // 1, a, s
  Eigen::VectorXd speed;
  Eigen::VectorXd apart;  // motor less camera
};

// Frames that were exposed while the reference moved, at this delay.
StretchProblem problem_at(const ElasticInput& input, double delay_s) {
  constexpr double kSpan_s = 5e-3;  // of the difference that makes an acceleration
  StretchProblem problem;
  std::vector<std::array<double, 4>> rows;
  std::vector<double> apart;
  for (std::size_t k = 0; k < input.frame_s.size(); ++k) {
    const double when = input.frame_s[k] - delay_s;
    const auto speed_at = [&](double t) {
      return interpolated(input.time_s, input.speed_m_per_s, t);
    };
    const double speed = speed_at(when);
    const double before = speed_at(when - kSpan_s);
    const double after = speed_at(when + kSpan_s);
    const double motor = interpolated(input.time_s, input.motor_m, when);
    if (!std::isfinite(motor) || !std::isfinite(before + after) || speed == 0) {
      continue;
    }
    rows.push_back({1, (after - before) / (2 * kSpan_s),
                    speed / (std::fabs(speed) + input.smoothing_m_per_s), speed});
    apart.push_back(motor - input.seen_m[k]);
    problem.when_s.push_back(when);
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  problem.regressors.resize(n, 3);
  problem.speed.resize(n);
  problem.apart.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    problem.regressors.row(i) << row[0], row[1], row[2];
    problem.speed(i) = row[3];
    problem.apart(i) = apart[static_cast<std::size_t>(i)];
  }
  return problem;
}

double mean_square(const ElasticInput& input, double delay_s) {
  const auto problem = problem_at(input, delay_s);
  const auto n = problem.apart.size();
  if (n < static_cast<Eigen::Index>(kFewestFrames)) {
    return INFINITY;
  }
  const Eigen::Vector3d found = least_squares(problem.regressors, problem.apart).x;
  return (problem.apart - problem.regressors * found).squaredNorm() / static_cast<double>(n);
}

// A coarse look, then thirds of the interval around the best.
double best_delay_s(const ElasticInput& input) {
  constexpr double kCoarse_s = 5e-3;
  double best = 0;
  double least = INFINITY;
  for (double delay = 0; delay <= input.longest_delay_s; delay += kCoarse_s) {
    const double square = mean_square(input, delay);
    if (square < least) {
      least = square;
      best = delay;
    }
  }
  double low = std::max(0.0, best - kCoarse_s);
  double high = best + kCoarse_s;
  while (high - low > 1e-6) {
    const double third = (high - low) / 3;
    if (mean_square(input, low + third) < mean_square(input, high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

ElasticError elastic_error(const ElasticInput& input) {
  ElasticError error;
  if (!std::isfinite(mean_square(input, 0)) &&
      !std::isfinite(mean_square(input, 0.5 * input.longest_delay_s))) {
    error.trouble = fmt::format("fewer than {} frames while the axis moves", kFewestFrames);
    return error;
  }
  const double delay = best_delay_s(input);
  const auto problem = problem_at(input, delay);
  const auto n = problem.apart.size();
  const Eigen::Vector3d found = least_squares(problem.regressors, problem.apart).x;
  const Eigen::VectorXd residual = problem.apart - problem.regressors * found;
  const double variance = residual.squaredNorm() / static_cast<double>(n - 4);
  // m(t - d) falls by v dd: the delay's column of the Jacobian.
  Eigen::MatrixXd jacobian(n, 4);
  jacobian << problem.regressors, problem.speed;
  const Eigen::MatrixXd covariance = variance * pseudo_inverse(jacobian.transpose() * jacobian);
  const auto within = [&](double value, int i) {
    return Within95{value, statistics::kNormal95 * std::sqrt(covariance(i, i))};
  };
  error.frames = static_cast<std::size_t>(n);
  error.offset_m = within(found(0), 0);
  error.per_acceleration_s2 = within(found(1), 1);
  error.friction_stretch_m = within(found(2), 2);
  error.delay_s = within(delay, 3);
  error.residual_rms_m = std::sqrt(variance);
  const Eigen::VectorXd modelled =
      problem.regressors.col(1) * found(1) + problem.regressors.col(2) * found(2);
  error.peak_m = modelled.cwiseAbs().maxCoeff();
  error.rms_m = std::sqrt(modelled.squaredNorm() / static_cast<double>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    error.exposed_s.push_back(problem.when_s[static_cast<std::size_t>(i)]);
    error.stretch_m.push_back(problem.apart(i) - found(0));
  }
  if (!(error.friction_stretch_m.half_width < error.peak_m)) {
    error.trouble =
        "the motion does not tell a late camera from a stretched transmission: reverse it, or "
        "change its "
        "speed";
  }
  return error;
}

}  // namespace towbench::study::identify
