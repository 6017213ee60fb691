#include "study/identify/secant_cost.h"

#include <utility>

#include <ceres/ceres.h>

namespace towbench::study::identify {
namespace {

// A step that changed the residuals by less than this share of themselves teaches nothing: what J
// missed is then the simulation's own grain.
constexpr double kGrain = 0.01;

}  // namespace

SecantCost::SecantCost(Residuals residuals, int count, std::vector<double> steps,
                       double most_missed)
    : residuals_(std::move(residuals)), steps_(std::move(steps)), most_missed_(most_missed) {
  set_num_residuals(count);
  mutable_parameter_block_sizes()->push_back(static_cast<int>(steps_.size()));
}

bool SecantCost::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const auto n = static_cast<Eigen::Index>(steps_.size());
  const Eigen::VectorXd point = Eigen::Map<const Eigen::VectorXd>(parameters[0], n);
  if (!seen(point)) {
    return false;
  }
  Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = tried_residual_;
  if (jacobians == nullptr || jacobians[0] == nullptr) {
    return true;
  }
  if (!(known_ && most_missed_ > 0 && bring_along(point)) && !difference(point)) {
    return false;
  }
  Eigen::Map<Jacobian>(jacobians[0], num_residuals(), n) = jacobian_;
  return true;
}

bool SecantCost::seen(const Eigen::VectorXd& point) const {
  if (tried_.size() == point.size() && tried_ == point) {
    return true;
  }
  tried_residual_.resize(num_residuals());
  tried_ = point;
  if (!residuals_(point.data(), tried_residual_.data())) {
    tried_.resize(0);
    return false;
  }
  return true;
}

bool SecantCost::bring_along(const Eigen::VectorXd& point) const {
  const Eigen::VectorXd step = point - point_;
  const Eigen::VectorXd change = tried_residual_ - residual_;
  const Eigen::VectorXd missed = change - jacobian_ * step;
  const Eigen::VectorXd blame = jacobian_.colwise().squaredNorm().transpose().cwiseProduct(step);
  const double whole = step.dot(blame);
  const bool tells = change.norm() > kGrain * residual_.norm() && whole > 0;
  if (tells && missed.norm() > most_missed_ * change.norm()) {
    return false;
  }
  if (tells) {
    jacobian_ += missed * (blame / whole).transpose();
  }
  point_ = point;
  residual_ = tried_residual_;
  return true;
}

bool SecantCost::difference(const Eigen::VectorXd& point) const {
  Eigen::VectorXd moved = point;
  Eigen::VectorXd there(num_residuals());
  jacobian_.resize(num_residuals(), point.size());
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const double step = steps_[static_cast<std::size_t>(i)];
    moved[i] = point[i] + step;
    if (!residuals_(moved.data(), there.data())) {
      return false;
    }
    jacobian_.col(i) = (there - tried_residual_) / step;
    moved[i] = point[i];
  }
  point_ = point;
  residual_ = tried_residual_;
  known_ = true;
  return true;
}

namespace {

class RoughEnd final : public ceres::IterationCallback {
 public:
  explicit RoughEnd(const Search& search) : search_(search) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    const bool rough = search_.rough_above > 0 && step.cost > search_.rough_above;
    const bool small = step.iteration > 0 && step.step_is_successful &&
                       step.cost_change < search_.rough_tolerance * step.cost;
    return rough && small ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const Search& search_;
};

}  // namespace

bool minimise(SecantCost& cost, const Search& search, Eigen::VectorXd& parameters,
              std::string& message) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, parameters.data());
  for (int i = 0; i < parameters.size(); ++i) {
    problem.SetParameterLowerBound(parameters.data(), i, search.bounds.low[i]);
    problem.SetParameterUpperBound(parameters.data(), i, search.bounds.high[i]);
  }
  ceres::Solver::Options options;
  options.max_num_iterations = 60;
  options.function_tolerance = search.tolerance;
  options.parameter_tolerance = 1e-8;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  RoughEnd rough_end(search);
  options.callbacks.push_back(&rough_end);
  for (int round = 0; round < search.most_rounds; ++round) {
    cost.forget();
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    message = summary.BriefReport();
    if (!summary.IsSolutionUsable()) {
      return false;
    }
    const bool rough = search.rough_above > 0 && summary.final_cost > search.rough_above;
    const double tolerance = rough ? search.rough_tolerance : search.tolerance;
    if (!(summary.initial_cost - summary.final_cost > 10 * tolerance * summary.final_cost)) {
      break;
    }
  }
  return true;
}

}  // namespace towbench::study::identify
