#include "tests/study/diagnose/foreign/block_means.h"

#include <Eigen/Dense>
#include <algorithm>

namespace towbench::tests::foreign {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool counts(const Recording& run) {
  return !run.plan.held_out && run.plan.motion != "pushed";
}

std::vector<Truth> block_means(const std::vector<Recording>& runs, double period_s,
                               double block_s) {
  constexpr double kMostlyMoving = 0.9;
  const auto length = std::max<std::size_t>(1, static_cast<std::size_t>(block_s / period_s));
  std::vector<Truth> means;
  for (const Recording& run : runs) {
    for (std::size_t from = 0; counts(run) && from + length <= run.truth.size(); from += length) {
      Truth mean;
      for (std::size_t i = from; i < from + length; ++i) {
        const double share = 1 / static_cast<double>(length);
        mean.t_s += share * run.truth[i].t_s;
        mean.x_m += share * run.truth[i].x_m;
        mean.lacking_N += share * run.truth[i].lacking_N;
        mean.a_m_per_s2 += share * run.truth[i].a_m_per_s2;
        mean.v_m_per_s += share * run.truth[i].v_m_per_s;
        mean.dry += share * run.truth[i].dry;
        mean.moving += share * run.truth[i].moving;
        mean.command_N += share * (run.truth[i].command_N + run.truth[i].hand_N);
      }
      if (mean.moving > kMostlyMoving) {
        means.push_back(mean);
      }
    }
  }
  return means;
}

MatrixXd file_columns(const std::vector<Truth>& means) {
  MatrixXd columns = MatrixXd::Ones(static_cast<Index>(means.size()), 4);
  for (Index i = 0; i < columns.rows(); ++i) {
    const Truth& mean = means[static_cast<std::size_t>(i)];
    columns.row(i).head(3) << mean.a_m_per_s2, mean.v_m_per_s, mean.dry;
  }
  return columns;
}

VectorXd unmade(MatrixXd columns, const VectorXd& y) {
  for (Index j = 0; j < columns.cols(); ++j) {
    columns.col(j) /= std::max(columns.col(j).norm(), 1e-300);
  }
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(1e-6);
  solver.compute(columns);
  return y - columns * solver.solve(y);
}

}  // namespace towbench::tests::foreign
