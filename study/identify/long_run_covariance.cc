#include "study/identify/long_run_covariance.h"

#include <Eigen/Core>
#include <algorithm>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {

Eigen::MatrixXd long_run_covariance(const Eigen::MatrixXd& scores, Eigen::Index lags) {
  const Eigen::Index n = scores.rows();
  Eigen::MatrixXd sum = scores.transpose() * scores;
  for (Eigen::Index lag = 1; lag <= std::min(lags, n - 1); ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    const Eigen::MatrixXd gamma = scores.bottomRows(n - lag).transpose() * scores.topRows(n - lag);
    sum += weight * (gamma + gamma.transpose());
  }
  return sum;
}

Eigen::MatrixXd sandwich(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                         const Eigen::MatrixXd& prior, Eigen::Index lags) {
  const Eigen::MatrixXd information = jacobian.transpose() * jacobian + prior;
  const Eigen::MatrixXd scores = jacobian.array().colwise() * residual.array();
  // A prior speaks as loudly as it would if it were data.
  const Eigen::MatrixXd meat = long_run_covariance(scores, lags) + prior;
  const Eigen::MatrixXd left = solve_symmetric(information, meat);
  return solve_symmetric(information, left.transpose());
}

}  // namespace towbench::study::identify
