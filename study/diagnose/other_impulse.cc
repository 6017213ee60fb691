#include "study/diagnose/other_impulse.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

constexpr Index kLookedAt = 8;  // samples of a window, for what is integrated

}  // namespace

OtherImpulse::OtherImpulse(const Run& run, const Motion& motion, const OtherAxis& other,
                           bool joints)
    : run_(run),
      motion_(motion),
      other_(other),
      other_motion_(motion_of(other, run.period_s)),
      joints_(joints) {
  if (!joints_) return;
  cos_q_ = other.position_m.array().cos().mean();
  sin_q_ = other.position_m.array().sin().mean();
  cos_x_ = run.position_m.array().cos().mean();
  sin_x_ = run.position_m.array().sin().mean();
}

void OtherImpulse::add_to(std::vector<double>& x, Index from, Index n) const {
  const Index to = from + n;
  const auto& q = other_.position_m;
  const auto& w = other_motion_.m_per_s;
  const auto& v = motion_.speed_m_per_s;
  x.insert(x.end(), {w[to] - w[from], q[to] - q[from]});
  if (!joints_) return;
  const auto change = [&](const auto& momentum) { return momentum(to) - momentum(from); };
  x.push_back(change([&](Index i) { return (std::cos(q[i]) - cos_q_) * w[i]; }));
  x.push_back(change([&](Index i) { return (std::sin(q[i]) - sin_q_) * w[i]; }));
  x.push_back(change([&](Index i) { return (std::cos(q[i]) - cos_q_) * v[i]; }));
  x.push_back(change([&](Index i) { return (std::sin(q[i]) - sin_q_) * v[i]; }));
  double own_cosine = 0;
  double own_sine = 0;
  double weight_cosine = 0;
  double weight_sine = 0;
  const Index stride = std::max<Index>(1, n / kLookedAt);
  const double T = run_.period_s * static_cast<double>(stride);
  for (Index i = from + stride / 2; i < to; i += stride) {
    const double place = run_.position_m[i];
    const double a = other_motion_.m_per_s2[i];
    const double square = w[i] * w[i];
    own_cosine += T * ((std::cos(place) - cos_x_) * a + std::sin(place) * square);
    own_sine += T * ((std::sin(place) - sin_x_) * a - std::cos(place) * square);
    weight_cosine += T * std::cos(place + q[i]);
    weight_sine += T * std::sin(place + q[i]);
  }
  x.insert(x.end(), {own_cosine, own_sine, weight_cosine, weight_sine});
}

std::vector<OtherImpulse> others_of(const Run& run, const Motion& motion, bool rotary) {
  std::vector<OtherImpulse> out;
  for (const OtherAxis& other : run.others) {
    out.emplace_back(run, motion, other, rotary && other.rotary);
  }
  return out;
}

}  // namespace towbench::study::diagnose
