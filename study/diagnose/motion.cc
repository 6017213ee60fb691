#include "study/diagnose/motion.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd slope(const VectorXd& x, Index reach, double period_s) {
  VectorXd out(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Index from = std::max<Index>(0, i - reach);
    const Index to = std::min(x.size() - 1, i + reach);
    out[i] = (x[to] - x[from]) / (static_cast<double>(to - from) * period_s);
  }
  return out;
}

VectorXd mean(const VectorXd& x, Index reach) {
  VectorXd sum(x.size() + 1);
  sum[0] = 0;
  for (Index i = 0; i < x.size(); ++i) {
    sum[i + 1] = sum[i] + x[i];
  }
  VectorXd out(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Index from = std::max<Index>(0, i - reach);
    const Index to = std::min(x.size(), i + reach);
    out[i] = (sum[to] - sum[from]) / static_cast<double>(to - from);
  }
  return out;
}

}  // namespace

Motion motion_of(const Run& run, double window_s) {
  const auto reach = std::clamp<Index>(std::lround(window_s / run.period_s), 1, run.size() / 8);
  Motion m;
  m.time_s = VectorXd::LinSpaced(run.size(), 0, run.period_s * static_cast<double>(run.size() - 1));
  m.position_m = run.position_m;
  m.speed_m_per_s = slope(run.position_m, reach, run.period_s);
  m.acceleration_m_per_s2 = slope(m.speed_m_per_s, reach, run.period_s);
  m.input_N = mean(mean(run.input_N, reach), reach);
  return m;
}

}  // namespace towbench::study::diagnose
