#include "harness/diagnose/cross_validation.h"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "harness/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostStretches = 30;
constexpr double kLengthsOfMemory = 3;  // of a stretch, as of the bootstrap's blocks (gain.cc)
constexpr Index kFolds = 4;

std::vector<Index> fold_of_each_row(const std::vector<Index>& starts, Index stretches) {
  std::vector<Index> folds;
  for (std::size_t run = 0; run + 1 < starts.size(); ++run) {
    const Index rows = starts[run + 1] - starts[run];
    for (Index row = 0; row < rows; ++row) {
      folds.push_back((row * stretches / rows) % kFolds);
    }
  }
  return folds;
}

VectorXd fitted_without(const Evidence& e, const std::vector<Index>& folds, Index left_out) {
  MatrixXd x(e.x.rows(), e.x.cols());
  VectorXd y(e.y.size());
  Index rows = 0;
  for (Index i = 0; i < e.y.size(); ++i) {
    if (folds[static_cast<std::size_t>(i)] != left_out) {
      x.row(rows) = e.x.row(i);
      y[rows++] = e.y[i];
    }
  }
  return x.topRows(rows).colPivHouseholderQr().solve(y.head(rows));
}

}  // namespace

Index stretches_of(const Evidence& e) {
  const auto runs = static_cast<double>(e.starts.size() - 1);
  const double rows = static_cast<double>(e.y.size()) / runs;
  const double length = kLengthsOfMemory * correlation_length(e.corrected, e.starts);
  return std::clamp(static_cast<Index>(rows / length), kFewestStretches, kMostStretches);
}

VectorXd cross_validated_residual(const Evidence& e, Index stretches) {
  const std::vector<Index> folds = fold_of_each_row(e.starts, stretches);
  const VectorXd twin_correction = e.coefficients - e.x.colPivHouseholderQr().solve(e.y);
  VectorXd residual(e.y.size());
  for (Index fold = 0; fold < kFolds; ++fold) {
    const VectorXd coefficients = fitted_without(e, folds, fold) + twin_correction;
    for (Index i = 0; i < residual.size(); ++i) {
      if (folds[static_cast<std::size_t>(i)] == fold) {
        residual[i] = e.y[i] - e.x.row(i).dot(coefficients);
      }
    }
  }
  return residual;
}

}  // namespace towbench::harness::diagnose
