#include "study/diagnose/known_terms.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
double interpolated(const std::vector<double>& at, const std::vector<double>& value, double x) {
  if (x <= at.front()) {
    return value.front();
  }
  if (x >= at.back()) {
    return value.back();
  }
  const auto next = static_cast<std::size_t>(
      std::distance(at.begin(), std::upper_bound(at.begin(), at.end(), x)));
  const double w = (x - at[next - 1]) / (at[next] - at[next - 1]);
  return (1 - w) * value[next - 1] + w * value[next];
}

double stribeck_share(const NominalModel& model, double speed_m_per_s) {
  const double x = speed_m_per_s / model.stribeck_speed_m_per_s;
  return model.stribeck_is_lorentz ? 1 / (1 + x * x) : std::exp(-x * x);
}

Eigen::VectorXd known_force_N(const NominalModel& model, const Signals& s) {
  if (model.elastic()) {
    return {};
  }
  Eigen::VectorXd force = Eigen::VectorXd::Zero(s.size());
  bool any = false;
  if (model.breakaway_excess_N > 0 && model.stribeck_speed_m_per_s > 0) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      force[i] +=
          model.breakaway_excess_N * stribeck_share(model, s.speed_m_per_s[i]) * s.direction[i];
    }
    any = true;
  }
  if (!model.friction_at_m.empty() && model.friction_at_m.size() == model.friction_N.size()) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      force[i] +=
          s.direction[i] * interpolated(model.friction_at_m, model.friction_N, s.position_m[i]);
    }
    any = true;
  }
  return any ? force : Eigen::VectorXd{};
}

void take_off_known_terms(std::vector<Run>& runs, const Baseline& baseline,
                          const Conditioning& conditioning) {
  for (Run& run : runs) {
    if (!baseline.model.elastic()) {
      run.known_N = known_force_N(baseline.model, make_signals(run, conditioning, baseline));
    }
  }
}

}  // namespace towbench::harness::diagnose
