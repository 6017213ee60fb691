#include "study/diagnose/cross_validation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "study/diagnose/wald.h"

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

// What the base columns leave of the input, fitted by what they leave of the causes: normal
// equations on columns of unit length, so that a stretch can be taken out of them.
class Fits {
 public:
  Fits(const Evidence& e, const VectorXd& by_law) {
    const MatrixXd base = orthonormal(e.x.leftCols(kBaseColumns));
    const MatrixXd causes = e.x.rightCols(by_law.size());
    const VectorXd scale = causes.colwise().norm().transpose().cwiseMax(1e-300);
    x_ = projected_off(base, causes.array().rowwise() / scale.transpose().array());
    y_ = projected_off(base, e.y);
    const double weight = 1 / static_cast<double>(x_.rows());
    gram_ = x_.transpose() * x_;
    gram_.diagonal().array() += weight;
    moment_ = x_.transpose() * y_ + weight * by_law.cwiseProduct(scale);
  }

  // Of a stretch, by all the others.
  [[nodiscard]] VectorXd residual(const Stretch& stretch) const {
    const VectorXd y = y_.segment(stretch.from, stretch.rows);
    if (x_.cols() == 0) {
      return y;
    }
    const auto x = x_.middleRows(stretch.from, stretch.rows);
    const MatrixXd gram = gram_ - x.transpose() * x;
    const VectorXd moment = moment_ - x.transpose() * y;
    return y - x * gram.ldlt().solve(moment);
  }

 private:
  VectorXd y_;
  MatrixXd x_;
  MatrixXd gram_;
  VectorXd moment_;
};

VectorXd said_by_law(const std::vector<Term>& terms, Index columns) {
  VectorXd out = VectorXd::Zero(columns);
  Index at = 0;
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
  const Fits fits(e, said_by_law(terms, e.x.cols() - kBaseColumns));
  VectorXd residual(e.y.size());
  for (const Stretch& s : stretches_in(e.starts, stretches)) {
    residual.segment(s.from, s.rows) = fits.residual(s);
  }
  return residual;
}

}  // namespace towbench::harness::diagnose
