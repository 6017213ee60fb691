#include "harness/diagnose/elastic_axis.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "harness/diagnose/direction.h"
#include "harness/diagnose/two_bodies.h"
#include "harness/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A load is out of step where its force, were stiffness and mass wholly other, would be off by more
// than this many times the force's own rms: then their last per mille is felt.
constexpr double kOutOfStep = 15;
constexpr double kEnvelope_s = 0.15;  // either side; a half swing and more
constexpr double kNudge = 0.01;       // relative, of a derivative by differences
constexpr double kSmallForce = 0.05;  // of dry friction, rms

// F of the elastic axis along a motor's motion.
VectorXd force_N(const Signals& s, const NominalModel& model, const Theta& theta,
                 const VectorXd& chain_N) {
  const TwoBodies bodies(model, theta);
  VectorXd force = model.chain.motor_kg * s.acceleration_m_per_s2 + chain_N;
  for (Index i = 0; i < s.size(); ++i) {
    force[i] += theta[kBias] + bodies.motor_friction_N(s.speed_m_per_s[i], s.direction[i]);
  }
  return force;
}

Signals load_signals(const Signals& motor, const Followed& followed) {
  Signals s;
  s.period_s = motor.period_s;
  s.time_s = motor.time_s;
  s.position_m = followed.load_m;
  s.speed_m_per_s = followed.load_m_per_s;
  s.acceleration_m_per_s2 = central_difference(followed.load_m_per_s, motor.period_s);
  s.input_N = followed.chain_N;
  s.other_speed_m_per_s = motor.other_speed_m_per_s;
  s.other_acceleration_m_per_s2 = motor.other_acceleration_m_per_s2;
  find_direction(s, 0);
  s.base.resize(s.size(), static_cast<Index>(kBaseColumns));
  s.base << s.acceleration_m_per_s2, s.speed_m_per_s, s.direction, VectorXd::Ones(s.size());
  return s;
}

std::vector<char> out_of_step(const VectorXd& sensitivity_N, const VectorXd& force_N,
                              double period_s) {
  const Index n = force_N.size();
  const double most = kOutOfStep * force_N.norm() / std::sqrt(static_cast<double>(n));
  const auto reach = static_cast<Index>(kEnvelope_s / period_s);
  std::vector<char> out(static_cast<std::size_t>(n), 0);
  for (Index i = 0; i < n; ++i) {
    if (std::abs(sensitivity_N[i]) > most) {
      const Index from = std::max<Index>(0, i - reach);
      std::fill(out.begin() + from, out.begin() + std::min(n, i + reach + 1), char{1});
    }
  }
  return out;
}

}  // namespace

Followed follow_motor(const NominalModel& model, const Theta& theta, const VectorXd& motor_m,
                      const VectorXd& motor_m_per_s, double period_s, const VectorXd& extra_N) {
  const TwoBodies bodies(model, theta);
  const Index n = motor_m.size();
  Followed out{VectorXd(n), VectorXd(n), VectorXd(n)};
  Motion load{motor_m[0], motor_m_per_s[0]};
  const auto steps = std::max(1, static_cast<int>(std::ceil(period_s / kLongestStep_s)));
  const double h = period_s / steps;
  for (Index k = 0; k < n; ++k) {
    out.load_m[k] = load.position_m;
    out.load_m_per_s[k] = load.speed_m_per_s;
    out.chain_N[k] = bodies.chain_N({motor_m[k], motor_m_per_s[k]}, load);
    const Index next = std::min(k + 1, n - 1);
    for (int i = 0; i < steps; ++i) {
      const double w = (i + 0.5) / steps;
      const Motion motor{(1 - w) * motor_m[k] + w * motor_m[next],
                         (1 - w) * motor_m_per_s[k] + w * motor_m_per_s[next]};
      const double extra = extra_N.size() == n ? (1 - w) * extra_N[k] + w * extra_N[next] : 0.0;
      bodies.step_load(load, motor, extra, h);
    }
  }
  return out;
}

VectorXd LoadSide::through_chain(const VectorXd& extra_N) const {
  const double n = static_cast<double>(std::max<Index>(1, extra_N.size()));
  const double rms = extra_N.norm() / std::sqrt(n);
  if (!(rms > 0)) {
    return extra_N;
  }
  const double dry = std::max(baseline.at[kCoulomb], 1e-3 * motion.input_N.norm() / std::sqrt(n));
  const double small = kSmallForce * std::max(dry, 1e-9) / rms;
  const Followed with = follow_motor(baseline.model, baseline.at, motor_m, motor_m_per_s,
                                     motion.period_s, small * extra_N);
  return (with.chain_N - chain_N) / small;
}

void put_on_chain(Signals& s, const Baseline& baseline) {
  const NominalModel& model = baseline.model;
  const auto force_at = [&](const NominalModel& of, const Theta& theta) {
    return force_N(
        s, of, theta,
        follow_motor(of, theta, s.position_m, s.speed_m_per_s, s.period_s, VectorXd{}).chain_N);
  };
  const Followed here =
      follow_motor(model, baseline.at, s.position_m, s.speed_m_per_s, s.period_s, VectorXd{});
  const VectorXd force = force_N(s, model, baseline.at, here.chain_N);
  s.base.resize(s.size(), static_cast<Index>(kBaseColumns));
  s.base.col(kBias).setOnes();
  for (const auto j : {kMass, kViscous, kCoulomb}) {
    Theta moved = baseline.at;
    const double nudge = kNudge * std::max(std::abs(moved[j]), 1e-3);
    moved[j] += nudge;
    s.base.col(j) = (force_at(model, moved) - force) / nudge;
  }
  s.known_N = force - s.base * baseline.at;
  auto load = std::make_shared<LoadSide>();
  load->motion = load_signals(s, here);
  load->baseline = baseline;
  load->motor_m = s.position_m;
  load->motor_m_per_s = s.speed_m_per_s;
  load->chain_N = here.chain_N;
  NominalModel stiffer = model;
  stiffer.chain.stiffness_N_per_m *= 1 + kNudge;
  NominalModel damped = model;
  damped.chain.damping_N_s_per_m *= 1 + kNudge;
  load->by_chain.resize(s.size(), 2);
  load->by_chain << (force_at(stiffer, baseline.at) - force) / kNudge,
      (force_at(damped, baseline.at) - force) / kNudge;
  const VectorXd sensitivity =
      baseline.at[kMass] * s.base.col(kMass).cwiseAbs() + load->by_chain.col(0).cwiseAbs();
  s.out_of_step = out_of_step(sensitivity, force, s.period_s);
  s.load = std::move(load);
}

}  // namespace towbench::harness::diagnose
