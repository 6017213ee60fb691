#include "study/identify/model_error.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {

double structure_error(const Eigen::VectorXd& residual, double right_rms) {
  const double right = static_cast<double>(residual.size()) * right_rms * right_rms;
  return std::sqrt(std::max(0.0, residual.squaredNorm() - right));
}

Eigen::VectorXd most_bent(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                          const Eigen::MatrixXd& prior, double right_rms) {
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian + prior;
  const Eigen::Index n = information.rows();
  const Eigen::VectorXd variance =
      solve_symmetric(information, Eigen::MatrixXd::Identity(n, n)).diagonal();
  return structure_error(residual, right_rms) * variance.cwiseMax(0.0).cwiseSqrt();
}

}  // namespace towbench::study::identify
