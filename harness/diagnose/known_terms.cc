#include "harness/diagnose/known_terms.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

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

}  // namespace

Eigen::VectorXd known_force_N(const NominalModel& model, const Signals& s) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(s.size());
  bool any = false;
  if (model.breakaway_excess_N > 0 && model.stribeck_speed_m_per_s > 0) {
    const Eigen::ArrayXd x2 = (s.speed_m_per_s.array() / model.stribeck_speed_m_per_s).square();
    const Eigen::ArrayXd fall =
        model.stribeck_is_lorentz ? (1 / (1 + x2)).eval() : (-x2).exp().eval();
    force.array() += model.breakaway_excess_N * fall * s.direction.array();
    any = true;
  }
  if (!model.friction_at_m.empty() && model.friction_at_m.size() == model.friction_N.size()) {
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      force[i] +=
          s.direction[i] * interpolated(model.friction_at_m, model.friction_N, s.position_m[i]);
    }
    any = true;
  }
  if (model.chain_load_kg > 0 && model.chain_frequency_Hz > 0) {
    const std::array<double, 2> scales{model.chain_frequency_Hz, model.chain_damping_ratio};
    force += model.chain_load_kg * find_effect("chain_elasticity")->columns(s, Context{}, scales);
    any = true;
  }
  return any ? force : Eigen::VectorXd{};
}

}  // namespace towbench::harness::diagnose
