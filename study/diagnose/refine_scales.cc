#include "study/diagnose/refine_scales.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

constexpr int kMostIterations = 8;

struct Projection {
  const Effect& effect;
  const Eigen::MatrixXd& basis;
  const Eigen::VectorXd& residual;
  const std::function<Eigen::MatrixXd(const Scales&)>& columns;
  std::size_t count;

  bool operator()(double const* const* log_scales, double* out) const {
    Scales scales(count);
    for (std::size_t i = 0; i < count; ++i) {
      scales[i] = std::exp(log_scales[0][i]);
    }
    const Eigen::MatrixXd group = projected_off(basis, columns(scales));
    Eigen::VectorXd beta = group.colPivHouseholderQr().solve(residual);
    if (effect.first_by_law > 0) {
      beta[0] = std::min(beta[0], effect.first_by_law);
    }
    Eigen::Map<Eigen::VectorXd>(out, residual.size()) = residual - group * beta;
    return beta.allFinite();
  }
};

}  // namespace

Scales refine_scales(const Effect& effect, const Scales& start, double reach,
                     const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual,
                     const std::function<Eigen::MatrixXd(const Scales&)>& columns) {
  std::vector<double> logs;
  for (const double scale : start) {
    logs.push_back(std::log(scale));
  }
  const auto count = static_cast<int>(start.size());
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = 1e-3 * std::min(1.0, reach);
  auto cost = std::make_unique<ceres::DynamicNumericDiffCostFunction<Projection, ceres::CENTRAL>>(
      new Projection{effect, basis, residual, columns, start.size()}, ceres::TAKE_OWNERSHIP, steps);
  cost->AddParameterBlock(count);
  cost->SetNumResiduals(static_cast<int>(residual.size()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost.release(), nullptr, logs.data());
  for (int i = 0; i < count; ++i) {
    const double centre = logs[static_cast<std::size_t>(i)];
    problem.SetParameterLowerBound(logs.data(), i, centre - reach);
    problem.SetParameterUpperBound(logs.data(), i, centre + reach);
  }
  ceres::Solver::Options options;
  options.max_num_iterations = kMostIterations;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    return start;
  }
  Scales out;
  for (const double value : logs) {
    out.push_back(std::exp(value));
  }
  return out;
}

}  // namespace towbench::harness::diagnose
