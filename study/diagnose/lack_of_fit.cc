#include "study/diagnose/lack_of_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "study/diagnose/spectral_lines.h"
#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBins = 16;
constexpr double kQuiet = 1e-4;
constexpr double kForceShare = 0.01;

struct Coordinate {
  std::string name;
  std::function<VectorXd(const Signals&)> raw;
};

std::vector<Coordinate> coordinates() {
  return {{"position_m", [](const Signals& s) { return s.position_m; }},
          {"speed_m_per_s", [](const Signals& s) { return s.speed_m_per_s; }},
          {"acceleration_m_per_s2", [](const Signals& s) { return s.acceleration_m_per_s2; }},
          {"input_N", [](const Signals& s) { return s.force_N(); }},
          {"time_s", [](const Signals& s) { return s.time_s; }},
          {"since_reversal_s", [](const Signals& s) { return s.since_reversal_s; }}};
}

// Bins of equal count, so that each mean is as well known as the others.
MatrixXd bins_of(const VectorXd& x, Unexplained& shape) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return x[a] < x[b]; });
  MatrixXd bins = MatrixXd::Zero(x.size(), kBins);
  shape.at.assign(static_cast<std::size_t>(kBins), 0.0);
  std::vector<double> count(static_cast<std::size_t>(kBins), 0.0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto bin = static_cast<std::size_t>(static_cast<Index>(i) * kBins / x.size());
    bins(order[i], static_cast<Index>(bin)) = 1;
    shape.at[bin] += x[order[i]];
    count[bin] += 1;
  }
  for (std::size_t b = 0; b < count.size(); ++b) {
    shape.at[b] /= std::max(1.0, count[b]);
  }
  return bins;
}

// What the model's own columns can make of the bins is no evidence: those directions are dropped.
MatrixXd independent(const MatrixXd& basis, const MatrixXd& bins) {
  const MatrixXd off = projected_off(basis, bins);
  Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(off.transpose() * off);
  const double largest = eigen.eigenvalues().maxCoeff();
  Index keep = 0;
  for (Index i = 0; i < kBins; ++i) {
    keep += eigen.eigenvalues()[i] > 0.05 * largest ? 1 : 0;
  }
  return bins * eigen.eigenvectors().rightCols(keep);
}

Unexplained along(const Dataset& data, const Evidence& e, const Coordinate& coordinate) {
  Unexplained shape;
  shape.coordinate = coordinate.name;
  const MatrixXd bins = bins_of(data.coordinate(coordinate.raw), shape);
  const WaldTest test = wald_test(e.basis, independent(e.basis, bins), e.corrected, e.starts);
  shape.p_value = test.p_value;
  shape.share = test.explained;
  shape.rms_N = test.projected_rms;
  const double independent_share = 1 / std::max(1.0, test.effective_samples);
  const double variance = e.corrected.squaredNorm() / static_cast<double>(e.corrected.size());
  for (Index b = 0; b < kBins; ++b) {
    const double count = bins.col(b).sum();
    shape.force_N.push_back(bins.col(b).dot(e.corrected) / std::max(1.0, count));
    shape.error_N.push_back(std::sqrt(variance * kBins * independent_share));
  }
  return shape;
}

// A line in time or position that no accepted effect has taken away.
Unexplained line_along(const Dataset& data, const Evidence& e, const Coordinate& coordinate,
                       double highest) {
  Unexplained shape;
  shape.coordinate = coordinate.name;
  const VectorXd x = data.coordinate(coordinate.raw);
  const double span = x.maxCoeff() - x.minCoeff();
  const Lines lines = find_lines(x, e.corrected, 3 / span, highest, 1);
  if (lines.frequency.empty()) {
    return shape;
  }
  const double f = lines.frequency.front();
  MatrixXd pair(x.size(), 2);
  pair.col(0) = (2 * std::numbers::pi * f * x.array()).cos();
  pair.col(1) = (2 * std::numbers::pi * f * x.array()).sin();
  const WaldTest test = wald_test(e.basis, pair, e.corrected, e.starts);
  shape.coordinate += " (line at " + std::to_string(f) + " per unit)";
  shape.p_value = std::min(1.0, test.p_value * static_cast<double>(lines.searched));
  shape.share = test.explained;
  shape.rms_N = test.projected_rms;
  for (int i = 0; i < kBins; ++i) {
    const double phase = 2 * std::numbers::pi * i / kBins;
    shape.at.push_back(i / (kBins * f));
    shape.force_N.push_back(test.beta[0] * std::cos(phase) + test.beta[1] * std::sin(phase));
    shape.error_N.push_back(std::sqrt(test.covariance(0, 0)));
  }
  return shape;
}

}  // namespace

std::optional<Unexplained> find_unexplained(const Dataset& data, const Evidence& e) {
  const auto all = coordinates();
  std::vector<Unexplained> shapes;
  for (const Coordinate& coordinate : all) {
    shapes.push_back(along(data, e, coordinate));
  }
  const double speed = data.coordinate(all[1].raw).cwiseAbs().maxCoeff();
  shapes.push_back(line_along(data, e, all[0], data.conditioning.cutoff_Hz / speed));
  shapes.push_back(line_along(data, e, all[4], data.conditioning.cutoff_Hz * 0.9));
  const double least_N =
      (data.baseline.model.elastic() ? kElasticFloor : kForceShare) * e.force_rms_N;
  std::optional<Unexplained> worst;
  for (Unexplained& shape : shapes) {
    shape.p_value = std::min(1.0, shape.p_value * static_cast<double>(shapes.size()));
    const bool fires =
        shape.p_value < kQuiet && shape.rms_N > least_N && shape.rms_N > 0.3 * e.reference_rms_N;
    if (fires && (!worst || shape.rms_N > worst->rms_N)) {
      worst = shape;
    }
  }
  return worst;
}

}  // namespace towbench::harness::diagnose
