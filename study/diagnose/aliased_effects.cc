#include "study/diagnose/aliased_effects.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostAlike = 2;  // beside the parameter itself

struct Fit {
  double chi2 = 1e300;
  bool accounts = false;
};

// How far the shifts are from what the effect alone would make of them.
Fit fit_of(const Candidate& c, const VectorXd& shift, const Evidence& e) {
  const MatrixXd w = e.x.colPivHouseholderQr().solve(c.columns).topRows(kBaseColumns);
  const Eigen::LDLT<MatrixXd> v(e.covariance.topLeftCorner(kBaseColumns, kBaseColumns));
  const MatrixXd weighted = v.solve(w);
  const VectorXd beta = (w.transpose() * weighted).ldlt().solve(weighted.transpose() * shift);
  if (!beta.allFinite() || (c.term.effect->first_is_positive && beta[0] <= 0)) {
    return {};
  }
  const VectorXd left = shift - w * beta;
  const double chi2 = left.dot(v.solve(left));
  const double rms_N = (e.x.leftCols(kBaseColumns) * left).norm() /
                       std::sqrt(static_cast<double>(std::max<Index>(1, e.y.size())));
  return {chi2, chi2 < kMovedErrors * kMovedErrors || rms_N < kMovedShare * e.force_rms_N};
}

void add_to_class(ParameterShift& shift, const std::string& name) {
  auto& alike = shift.indistinguishable_from;
  const bool known = std::find(alike.begin(), alike.end(), name) != alike.end();
  if (shift.moved && !known && alike.size() < kMostAlike) {
    alike.push_back(name);
  }
}

}  // namespace

void find_aliased_effects(std::vector<ParameterShift>& shifts, const Selection& selection) {
  VectorXd shift(static_cast<Index>(shifts.size()));
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    shift[static_cast<Index>(i)] = shifts[i].fitted.value - shifts[i].supplied;
  }
  std::vector<std::pair<double, std::string>> found;
  for (const Candidate& c : selection.last_round) {
    if (c.test.left_of_group < kLeastLeft && c.columns.norm() > 0) {
      const Fit fit = fit_of(c, shift, selection.after);
      if (fit.accounts) {
        found.emplace_back(fit.chi2, c.term.effect->name);
      }
    }
  }
  std::sort(found.begin(), found.end());
  for (const auto& [chi2, name] : found) {
    for (ParameterShift& each : shifts) {
      add_to_class(each, name);
    }
  }
}

}  // namespace towbench::harness::diagnose
