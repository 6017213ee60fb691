// Covariance of a sum of correlated scores.
//
//   S = sum over lags |l| <= L of (1 - |l| / (L + 1)) sum_t s_t s_(t-l)'      Newey and West 1987
#pragma once

#include <Eigen/Core>

namespace towbench::study::identify {

// `scores`: one row a sample, mean near zero. `lags` >= 0.
[[nodiscard]] Eigen::MatrixXd long_run_covariance(const Eigen::MatrixXd& scores, Eigen::Index lags);

// Of the least-squares estimate whose residual is `residual` and whose Jacobian is `jacobian`:
// (J'J)^-1 S (J'J)^-1, S of the rows J_t e_t. `prior` is added to J'J.
[[nodiscard]] Eigen::MatrixXd sandwich(const Eigen::MatrixXd& jacobian,
                                       const Eigen::VectorXd& residual,
                                       const Eigen::MatrixXd& prior, Eigen::Index lags);

}  // namespace towbench::study::identify
