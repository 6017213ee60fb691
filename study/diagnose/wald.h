// Does a group of columns explain a residual, given the columns already in the model?
//
// Group Wald test with a heteroskedasticity and autocorrelation consistent (HAC) covariance:
//   beta = (P'P)^-1 P'r,  P = group projected off the model's columns
//   V    = (P'P)^-1 S (P'P)^-1,  S = sum over lags |l| <= L of (1 - |l|/(L+1)) Gamma_l of the
//          scores P_t e_t (Newey & West 1987), L by Andrews' (1991) AR(1) plug-in, his (6.2), (6.4)
//   W    = beta' V^-1 beta; W/k is compared with F(k, n_eff - k), n_eff the number of samples over
//          their long-run variance ratio, because the chi-square limit rejects too often when few
//          independent samples are left.
// Plain t-values treat a residual that lasts for a second as a thousand facts.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace towbench::harness::diagnose {

struct WaldTest {
  Eigen::VectorXd beta;
  Eigen::MatrixXd covariance;
  double p_value = 1;
  double explained = 0;      // share of the residual's energy that the group takes away
  double projected_rms = 0;  // of the group's fitted contribution, off the model's columns
  double left_of_group = 0;  // rms of projected columns over rms of the columns, worst of group
  double effective_samples = 0;
};

// An orthonormal basis of a matrix's columns; columns that depend on others are dropped.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);
[[nodiscard]] Eigen::MatrixXd projected_off(const Eigen::MatrixXd& basis,
                                            const Eigen::MatrixXd& columns);

// `starts` separates runs: no lag reaches across. `basis` is orthonormal.
[[nodiscard]] WaldTest wald_test(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& group,
                                 const Eigen::VectorXd& residual,
                                 const std::vector<Eigen::Index>& starts);

// HAC long-run covariance, summed over samples, of mean-zero scores.
[[nodiscard]] Eigen::MatrixXd hac_covariance(const Eigen::MatrixXd& scores,
                                             const std::vector<Eigen::Index>& starts);
// Samples over which a series forgets itself: 1 + 2 sum of its autocorrelations, at least 1.
[[nodiscard]] double correlation_length(const Eigen::VectorXd& series,
                                        const std::vector<Eigen::Index>& starts);

}  // namespace towbench::harness::diagnose
