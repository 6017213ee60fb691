#include "study/diagnose/flanks.h"

#include <cmath>

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Below this share of its rms the chain's force does not say which flank carries.
constexpr double kUndecidedForce = 0.1;

void fill(VectorXd& side, const Flanks::Gap& gap) {
  for (Index k = gap.from + 1; k < gap.to; ++k) {
    const double u = static_cast<double>(k - gap.from) / static_cast<double>(gap.to - gap.from);
    const double step = u * u * (3 - 2 * u);
    side[k] = (1 - step) * side[gap.from] + step * side[gap.to];
  }
}

void cross(VectorXd& way, const Flanks::Gap& gap) {
  const Index rows = gap.to - gap.from;
  const double before = (way[gap.from] - way[gap.from - 1]) * static_cast<double>(rows);
  const double after = (way[gap.to + 1] - way[gap.to]) * static_cast<double>(rows);
  const double from = way[gap.from];
  const double far = way[gap.to] - from;
  for (Index k = 1; k < rows; ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(rows);
    way[gap.from + k] =
        from + u * u * (3 - 2 * u) * far + u * (1 - u) * (1 - u) * before - u * u * (1 - u) * after;
  }
}

}  // namespace

Flanks find_flanks(const VectorXd& chain_N) {
  const double least =
      kUndecidedForce * chain_N.norm() / std::sqrt(static_cast<double>(chain_N.size()));
  Flanks flanks{VectorXd::Zero(chain_N.size()), {}};
  Index last = -1;
  for (Index i = 0; i < chain_N.size(); ++i) {
    if (std::abs(chain_N[i]) <= least) {
      continue;
    }
    flanks.side[i] = chain_N[i] > 0 ? 1 : -1;
    if (last >= 0) {
      fill(flanks.side, {last, i});
    }
    if (last > 0 && i + 1 < chain_N.size() && flanks.side[last] != flanks.side[i]) {
      flanks.gaps.push_back({last, i});
    }
    last = i;
  }
  return flanks;
}

VectorXd crossed(const Flanks& flanks, VectorXd load_m, double play_m) {
  if (play_m > 0) {
    for (const Flanks::Gap& gap : flanks.gaps) {
      cross(load_m, gap);
    }
  }
  return load_m;
}

}  // namespace towbench::harness::diagnose
