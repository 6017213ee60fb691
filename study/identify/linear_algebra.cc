#include "study/identify/linear_algebra.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace towbench::study::identify {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LeastSquares least_squares(const MatrixView& a, const VectorView& b) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  return {qr.solve(b), qr.rank()};
}

VectorXd least_norm_solution(const MatrixView& a, const VectorView& b) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a).solve(b);
}

MatrixXd pseudo_inverse(const MatrixView& a) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a).pseudoInverse();
}

MatrixXd solve_symmetric(const MatrixView& a, const MatrixView& b) {
  return Eigen::LDLT<MatrixXd>(a).solve(b);
}

VectorXd solve_square(const MatrixView& a, const VectorView& b) {
  return Eigen::PartialPivLU<MatrixXd>(a).solve(b);
}

MatrixXd inverse(const MatrixView& a) {
  return Eigen::PartialPivLU<MatrixXd>(a).inverse();
}

MatrixXd exponential(const MatrixView& a) {
  return MatrixXd(a).exp();
}

std::vector<std::complex<double>> eigenvalues(const MatrixView& a) {
  const Eigen::EigenSolver<MatrixXd> solver(a, false);
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

}  // namespace towbench::study::identify
