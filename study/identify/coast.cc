#include "study/identify/coast.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <ceres/ceres.h>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

// Residuals of all spans for given logarithms of J/B, swing frequency and swing decay.
class Coasts {
 public:
  Coasts(const Recording& data, core::Axis axis, const std::vector<CoastSpan>& spans)
      : data_(data), axis_(axis), spans_(spans) {
    for (const auto& span : spans_) {
      rows_ += static_cast<int>(span.to - span.from);
    }
  }
  [[nodiscard]] int rows() const { return rows_; }

  bool operator()(double const* const* parameters, double* residuals) const {
    const double* p = parameters[0];
    const double rate = std::exp(-p[0]);
    const double w = 2 * std::numbers::pi * std::exp(p[1]);
    const double decay = std::exp(p[2]);
    for (const auto& span : spans_) {
      const auto n = static_cast<Eigen::Index>(span.to - span.from);
      Eigen::MatrixXd shapes(n, 5);
      Eigen::VectorXd counts(n);
      const auto& axis = data_.axes[axis_];
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = span.from + static_cast<std::size_t>(i);
        const double t = data_.time_s[k] - data_.time_s[span.from];
        const double swing = std::exp(-decay * t);
        // expm1 less its first term: what is not already a straight line.
        const double bend = std::expm1(-rate * t) + rate * t;
        shapes.row(i) << 1, t, bend / (rate * rate), swing * std::cos(w * t),
            swing * std::sin(w * t);
        counts[i] = static_cast<double>(axis.count[k] - axis.count[span.from]);
      }
      const Eigen::VectorXd left = counts - shapes * least_squares(shapes, counts).x;
      Eigen::Map<Eigen::VectorXd>(residuals, n) = left;
      residuals += n;
    }
    return true;
  }

 private:
  const Recording& data_;
  core::Axis axis_;
  const std::vector<CoastSpan>& spans_;
  int rows_ = 0;
};

double speed_over(const Recording& data, core::Axis axis, std::size_t from, std::size_t to) {
  return (data.position_m(axis, to) - data.position_m(axis, from)) /
         (data.time_s[to] - data.time_s[from]);
}

// The row after the last in which the motor is faster; the span's first when it is in none.
std::size_t slow_enough(const Recording& data, core::Axis axis, const CoastSpan& span,
                        double fastest_m_per_s) {
  constexpr double kFew_s = 0.003;  // a tenth of the quickest swing
  const auto few =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kFew_s / data.period_s)));
  std::size_t from = span.from;
  for (std::size_t k = span.from; k + few < span.to; ++k) {
    if (std::fabs(speed_over(data, axis, k, k + few)) > fastest_m_per_s) {
      from = k + few;
    }
  }
  return from;
}

}  // namespace

std::vector<CoastSpan> find_coasts(const Recording& data, core::Axis axis,
                                   const CoastLimits& limits) {
  constexpr double kSpan_s = 0.02;
  constexpr double kShortest_s = 0.05;
  const auto span = static_cast<std::size_t>(std::lround(kSpan_s / data.period_s));
  const auto& duty = data.axes[axis].duty_pct;
  std::vector<CoastSpan> found;
  for (std::size_t k = 1; k + span < data.rows(); ++k) {
    if (duty[k] != 0 || duty[k - 1] == 0) {
      continue;
    }
    const double first = std::fabs(speed_over(data, axis, k, k + span));
    std::size_t end = k;
    while (end + span < data.rows() && duty[end] == 0 && duty[end + span] == 0 &&
           std::fabs(speed_over(data, axis, end, end + span)) > limits.lowest_share * first) {
      ++end;
    }
    // The current needs a row to be gone.
    const auto from = slow_enough(data, axis, {k + 2, end}, limits.fastest_m_per_s);
    if (static_cast<double>(end) - static_cast<double>(from) >= kShortest_s / data.period_s) {
      found.push_back({from, end});
    }
  }
  return found;
}

CoastFit fit_coasts(const Recording& data, core::Axis axis, const std::vector<CoastSpan>& spans,
                    double first_s, double first_Hz) {
  CoastFit fit;
  const Coasts coasts(data, axis, spans);
  if (spans.empty() || coasts.rows() < 50) {
    return fit;
  }
  double p[3] = {std::log(first_s), std::log(first_Hz),
                 std::log(0.05 * 2 * std::numbers::pi * first_Hz)};
  const double first[3] = {p[0], p[1], p[2]};
  auto* cost =
      new ceres::DynamicNumericDiffCostFunction<Coasts>(&coasts, ceres::DO_NOT_TAKE_OWNERSHIP);
  cost->AddParameterBlock(3);
  cost->SetNumResiduals(coasts.rows());
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, p);
  const double room[3] = {2.0, 0.6, 1.5};
  for (int i = 0; i < 3; ++i) {
    problem.SetParameterLowerBound(p, i, first[i] - room[i]);
    problem.SetParameterUpperBound(p, i, first[i] + room[i]);
  }
  ceres::Solver::Options options;
  options.max_num_iterations = 60;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  fit.time_constant_s = std::exp(p[0]);
  fit.swing_Hz = std::exp(p[1]);
  fit.residual_rms_counts = std::sqrt(2 * summary.final_cost / coasts.rows());
  fit.converged = summary.IsSolutionUsable() && std::fabs(p[0] - first[0]) < room[0] - 1e-3;
  return fit;
}

}  // namespace towbench::study::identify
