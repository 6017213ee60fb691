#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

// Eigen's decompositions as functions of matrices of dynamic size. Each takes seconds to compile,
// so it is compiled here, and not once for each size that a caller has.
namespace towbench::study::identify {

using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;
using VectorView = Eigen::Ref<const Eigen::VectorXd>;

// min |a x - b|; QR with column pivoting.
struct LeastSquares {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;
};
[[nodiscard]] LeastSquares least_squares(const MatrixView& a, const VectorView& b);

// Of all x with the least |a x - b| the shortest: for columns that depend on each other.
[[nodiscard]] Eigen::VectorXd least_norm_solution(const MatrixView& a, const VectorView& b);

[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const MatrixView& a);

// a x = b with a symmetric and positive semi-definite; a column of x for each of b.
[[nodiscard]] Eigen::MatrixXd solve_symmetric(const MatrixView& a, const MatrixView& b);

// a x = b with a square and regular; not finite where it is not.
[[nodiscard]] Eigen::VectorXd solve_square(const MatrixView& a, const VectorView& b);

[[nodiscard]] Eigen::MatrixXd inverse(const MatrixView& a);
[[nodiscard]] Eigen::MatrixXd exponential(const MatrixView& a);
[[nodiscard]] std::vector<std::complex<double>> eigenvalues(const MatrixView& a);

}  // namespace towbench::study::identify
