#include "study/prediction/scene.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Over a window that a quantised encoder does not fill with steps alone.
VectorXd speed_of(const VectorXd& x, double period_s, Index reach) {
  const Index n = x.size();
  VectorXd out(n);
  for (Index i = 0; i < n; ++i) {
    const Index from = std::max<Index>(i - reach, 0);
    const Index to = std::min(i + reach, n - 1);
    out[i] = (x[to] - x[from]) / (static_cast<double>(to - from) * period_s);
  }
  return out;
}

// On lines between knots, level outside; zero without knots.
double between(const std::vector<double>& at, const std::vector<double>& value,
               double at_m) noexcept {
  if (at.empty()) {
    return 0;
  }
  const auto after = std::upper_bound(at.begin(), at.end(), at_m);
  if (after == at.begin()) {
    return value.front();
  }
  if (after == at.end()) {
    return value.back();
  }
  const auto i = static_cast<std::size_t>(after - at.begin());
  const double share = (at_m - at[i - 1]) / (at[i] - at[i - 1]);
  return value[i - 1] + share * (value[i] - value[i - 1]);
}

}  // namespace

OtherMotion motion_of(const OtherAxis& other, double period_s) {
  const auto reach = std::max<Index>(2, std::lround(0.01 / period_s));
  OtherMotion m;
  m.m_per_s = speed_of(other.position_m, period_s, reach);
  m.m_per_s2 = speed_of(m.m_per_s, period_s, reach);
  return m;
}

Scene::Scene(const Run& given, const NominalModel& model)
    : run(&given),
      stated(&model),
      held(model.input_is_held),
      substeps(std::max(1, static_cast<int>(std::ceil(given.period_s / kLongestStep_s - 1e-9)))) {
  const VectorXd& u = run->input_N;
  impulse_Ns.resize(u.size());
  double sum = 0;
  for (Index i = 0; i < u.size(); ++i) {
    impulse_Ns[i] = sum;
    const double next = i + 1 < u.size() ? u[i + 1] : u[i];
    sum += run->period_s * (held ? u[i] : 0.5 * (u[i] + next));
  }
  mean_N.resize(u.size() * substeps);
  for (Index i = 0; i < u.size(); ++i) set_means(i);
  for (const OtherAxis& other : run->others) others.push_back(motion_of(other, run->period_s));
}

void Scene::set_means(Index k) noexcept {
  const double h = run->period_s / substeps;
  for (int i = 0; i < substeps; ++i) {
    mean_N[k * substeps + i] =
        mean_input_N(static_cast<double>(k) * run->period_s + static_cast<double>(i) * h, h);
  }
}

double Scene::impulse_at(double at_s) const noexcept {
  const VectorXd& u = run->input_N;
  const double place = at_s / run->period_s;
  if (place <= 0) {
    return u[0] * at_s;
  }
  const auto k = std::min(static_cast<Index>(place), u.size() - 1);
  const double s = at_s - static_cast<double>(k) * run->period_s;
  const double next = k + 1 < u.size() && !held ? u[k + 1] : u[k];
  return impulse_Ns[k] + s * (u[k] + 0.5 * s / run->period_s * (next - u[k]));
}

double stated_friction_N(const NominalModel& stated, double at_m) noexcept {
  return between(stated.friction_at_m, stated.friction_N, at_m);
}

double stated_force_N(const NominalModel& stated, double at_m) noexcept {
  return between(stated.force_at_m, stated.force_N, at_m) +
         stated.cable_N_per_m * (at_m - stated.cable_at_m);
}

}  // namespace towbench::study::diagnose
