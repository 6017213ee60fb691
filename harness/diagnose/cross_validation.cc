#include "harness/diagnose/cross_validation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "harness/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kFewestStretches = 12;
constexpr Index kMostStretches = 30;
constexpr double kLengthsOfMemory = 3;  // of a stretch, as of the bootstrap's blocks (gain.cc)

struct Stretch {
  Index from;
  Index rows;
};

std::vector<Stretch> stretches_in(const std::vector<Index>& starts, Index stretches) {
  std::vector<Stretch> out;
  for (std::size_t run = 0; run + 1 < starts.size(); ++run) {
    const Index rows = starts[run + 1] - starts[run];
    for (Index i = 0; i < stretches; ++i) {
      const Index from = i * rows / stretches;
      out.push_back({starts[run] + from, (i + 1) * rows / stretches - from});
    }
  }
  return out;
}

// Least squares by its normal equations on columns of unit length, so that a stretch can be taken
// out of them.
class Fits {
 public:
  Fits(const Evidence& e, const VectorXd& by_law)
      : y_(e.y), scale_(e.x.colwise().norm().transpose().cwiseMax(1e-300)) {
    x_ = e.x.array().rowwise() / scale_.transpose().array();
    gram_ = x_.transpose() * x_;
    moment_ = x_.transpose() * y_;
    const Index causes = x_.cols() - kBaseColumns;
    const double weight = 1 / static_cast<double>(x_.rows());
    gram_.diagonal().tail(causes).array() += weight;
    moment_ += weight * by_law.cwiseProduct(scale_);
  }

  [[nodiscard]] VectorXd without(const Stretch& stretch) const {
    const auto x = x_.middleRows(stretch.from, stretch.rows);
    const MatrixXd gram = gram_ - x.transpose() * x;
    const VectorXd moment = moment_ - x.transpose() * y_.segment(stretch.from, stretch.rows);
    return gram.ldlt().solve(moment).cwiseQuotient(scale_);
  }

 private:
  const VectorXd& y_;
  VectorXd scale_;
  MatrixXd x_;
  MatrixXd gram_;
  VectorXd moment_;
};

VectorXd said_by_law(const std::vector<Term>& terms, Index columns) {
  VectorXd out = VectorXd::Zero(columns);
  Index at = kBaseColumns;
  for (const Term& term : terms) {
    out[at] = term.effect->first_by_law;
    at += static_cast<Index>(term.effect->coefficients.size());
  }
  return out;
}

}  // namespace

Index stretches_of(const Evidence& e) {
  const auto runs = static_cast<double>(e.starts.size() - 1);
  const double rows = static_cast<double>(e.y.size()) / runs;
  const double length = kLengthsOfMemory * correlation_length(e.corrected, e.starts);
  return std::clamp(static_cast<Index>(rows / length), kFewestStretches, kMostStretches);
}

VectorXd cross_validated_residual(const Evidence& e, const std::vector<Term>& terms,
                                  Index stretches) {
  const Fits fits(e, said_by_law(terms, e.x.cols()));
  VectorXd residual(e.y.size());
  for (const Stretch& s : stretches_in(e.starts, stretches)) {
    residual.segment(s.from, s.rows) =
        e.y.segment(s.from, s.rows) - e.x.middleRows(s.from, s.rows) * fits.without(s);
  }
  return residual;
}

}  // namespace towbench::harness::diagnose
