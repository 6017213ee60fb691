#include "study/diagnose/wald.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <boost/math/distributions/fisher_f.hpp>

namespace towbench::harness::diagnose {
namespace {

// First autocorrelation of each column; runs apart.
double lag_one(const Eigen::Ref<const Eigen::VectorXd>& x,
               const std::vector<Eigen::Index>& starts) {
  double cross = 0;
  for (std::size_t run = 0; run + 1 < starts.size(); ++run) {
    const Eigen::Index n = starts[run + 1] - starts[run];
    if (n > 1) {
      cross += x.segment(starts[run], n - 1).dot(x.segment(starts[run] + 1, n - 1));
    }
  }
  const double energy = x.squaredNorm();
  return energy > 0 ? std::clamp(cross / energy, -0.97, 0.97) : 0.0;
}

// Andrews (1991): alpha(1) = sum 4 rho^2 s^4 / ((1-rho)^6 (1+rho)^2) / sum s^4 / (1-rho)^4,
// L = 1.1447 (alpha(1) n)^(1/3) for the Bartlett kernel.
Eigen::Index automatic_lag(const Eigen::MatrixXd& scores, const std::vector<Eigen::Index>& starts) {
  double above = 0;
  double below = 0;
  const auto n = static_cast<double>(scores.rows());
  for (Eigen::Index j = 0; j < scores.cols(); ++j) {
    const double rho = lag_one(scores.col(j), starts);
    const double scale = scores.col(j).squaredNorm() / n;
    if (scale <= 0) {
      continue;
    }
    const double weight = 1.0;  // each column in units of its own variance
    above += weight * 4 * rho * rho / (std::pow(1 - rho, 2) * std::pow(1 + rho, 2)) *
             std::pow((1 + rho) * (1 - rho), 2) / std::pow(1 - rho, 4);
    below += weight * std::pow((1 + rho) * (1 - rho), 2) / std::pow(1 - rho, 4);
  }
  const double alpha = below > 0 ? above / below : 0;
  return static_cast<Eigen::Index>(
      std::min(n / 4, std::ceil(1.1447 * std::cbrt(std::max(alpha, 0.1) * n))));
}

}  // namespace

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd scaled = columns;
  for (Eigen::Index j = 0; j < scaled.cols(); ++j) {
    const double norm = scaled.col(j).norm();
    if (norm > 0) {
      scaled.col(j) /= norm;
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  qr.setThreshold(1e-7);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

Eigen::MatrixXd projected_off(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns) {
  return columns - basis * (basis.transpose() * columns);
}

Eigen::MatrixXd hac_covariance(const Eigen::MatrixXd& scores,
                               const std::vector<Eigen::Index>& starts) {
  const Eigen::Index lag = automatic_lag(scores, starts);
  Eigen::MatrixXd sum = scores.transpose() * scores;
  for (Eigen::Index l = 1; l <= lag; ++l) {
    const double weight = 1.0 - static_cast<double>(l) / static_cast<double>(lag + 1);
    for (std::size_t run = 0; run + 1 < starts.size(); ++run) {
      const Eigen::Index n = starts[run + 1] - starts[run] - l;
      if (n < 1) {
        continue;
      }
      const Eigen::MatrixXd gamma =
          scores.middleRows(starts[run], n).transpose() * scores.middleRows(starts[run] + l, n);
      sum += weight * (gamma + gamma.transpose());
    }
  }
  return sum;
}

double correlation_length(const Eigen::VectorXd& series, const std::vector<Eigen::Index>& starts) {
  const double energy = series.squaredNorm();
  if (energy <= 0) {
    return 1;
  }
  return std::max(1.0, hac_covariance(series, starts)(0, 0) / energy);
}

WaldTest wald_test(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& group,
                   const Eigen::VectorXd& residual, const std::vector<Eigen::Index>& starts) {
  WaldTest test;
  const Eigen::Index k = group.cols();
  Eigen::VectorXd scale = group.colwise().norm().transpose();
  Eigen::MatrixXd p = projected_off(basis, group);
  const Eigen::VectorXd r = projected_off(basis, residual);
  test.beta = Eigen::VectorXd::Zero(k);
  test.covariance = Eigen::MatrixXd::Zero(k, k);
  test.left_of_group = 1;
  for (Eigen::Index j = 0; j < k; ++j) {
    if (!(scale[j] > 0)) {
      test.left_of_group = 0;
      return test;
    }
    test.left_of_group = std::min(test.left_of_group, p.col(j).norm() / scale[j]);
    p.col(j) /= scale[j];
  }
  const Eigen::MatrixXd gram = p.transpose() * p;
  const Eigen::LDLT<Eigen::MatrixXd> solver(gram);
  if (gram.diagonal().minCoeff() < 1e-9 || solver.rcond() < 1e-9) {
    test.left_of_group = std::min(test.left_of_group, 1e-5);
    return test;
  }
  const Eigen::VectorXd beta = solver.solve(p.transpose() * r);
  const Eigen::VectorXd fitted = p * beta;
  const Eigen::VectorXd left = r - fitted;
  const Eigen::MatrixXd scores = p.array().colwise() * left.array();
  const Eigen::MatrixXd bread = solver.solve(Eigen::MatrixXd::Identity(k, k));
  const Eigen::MatrixXd v = bread * hac_covariance(scores, starts) * bread;
  const auto n = static_cast<double>(residual.size());
  test.effective_samples = n / correlation_length(left, starts);
  const double w = beta.dot(v.ldlt().solve(beta));
  const double energy = r.squaredNorm();
  test.explained = energy > 0 ? fitted.squaredNorm() / energy : 0;
  test.projected_rms = fitted.norm() / std::sqrt(n);
  const double freedom = std::max(
      3.0, test.effective_samples - static_cast<double>(k) - static_cast<double>(basis.cols()));
  if (std::isfinite(w) && w > 0) {
    const boost::math::fisher_f law(static_cast<double>(k), freedom);
    test.p_value = boost::math::cdf(boost::math::complement(law, w / static_cast<double>(k)));
  }
  const Eigen::VectorXd unscale = scale.cwiseInverse();
  test.beta = beta.cwiseProduct(unscale);
  test.covariance = unscale.asDiagonal() * v * unscale.asDiagonal();
  return test;
}

}  // namespace towbench::harness::diagnose
