#include "study/diagnose/elastic_axis.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "study/diagnose/direction.h"
#include "study/diagnose/flanks.h"
#include "study/diagnose/known_law.h"
#include "study/diagnose/two_bodies.h"
#include "study/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// (k + d D)^-1 F, exact for a force that is linear between samples.
VectorXd stretch_m(const ElasticChain& chain, const VectorXd& force_N, double period_s) {
  const double k = chain.stiffness_N_per_m;
  const double rho = period_s * k / std::max(chain.damping_N_s_per_m, 1e-12 * k);
  const double keeps = std::exp(-rho);
  const double ramp = (1 - keeps) / rho;
  VectorXd s(force_N.size());
  double before = force_N[0];
  double last = before / k;
  for (Index i = 0; i < s.size(); ++i) {
    last = keeps * last + ((1 - ramp) * force_N[i] + (ramp - keeps) * before) / k;
    before = force_N[i];
    s[i] = last;
  }
  return s;
}

// The load's law for what is known of one run at one point of linearisation.
class LoadLaw {
 public:
  LoadLaw(const Baseline& baseline, double period_s)
      : chain_(shifted(baseline.model.chain, baseline.read)),
        bodies_(baseline.model, baseline.at),
        period_s_(period_s) {}

  // (M D^2 + share B D) of a way.
  [[nodiscard]] VectorXd inertial_N(const VectorXd& way_m) const {
    const VectorXd speed = central_difference(way_m, period_s_);
    return bodies_.load_mass_kg() * central_difference(speed, period_s_) +
           bodies_.load_viscous_N_s_per_m() * speed;
  }
  [[nodiscard]] VectorXd stretch_m(const VectorXd& force_N) const {
    return diagnose::stretch_m(chain_, force_N, period_s_);
  }
  [[nodiscard]] VectorXd of_motor_force(const VectorXd& force_N) const {
    return force_N + inertial_N(stretch_m(force_N));
  }
  [[nodiscard]] const TwoBodies& bodies() const noexcept { return bodies_; }
  [[nodiscard]] const ElasticChain& chain() const noexcept { return chain_; }

 private:
  ElasticChain chain_;
  TwoBodies bodies_;
  double period_s_;
};

VectorXd motor_force_N(const Signals& s, const Baseline& baseline, const TwoBodies& bodies) {
  VectorXd force = baseline.model.chain.motor_kg * s.acceleration_m_per_s2;
  for (Index i = 0; i < s.size(); ++i) {
    force[i] += baseline.at[kBias] + bodies.motor_friction_N(s.speed_m_per_s[i], s.direction[i]);
  }
  return force;
}

Signals load_signals(const Signals& motor, const VectorXd& load_m, const VectorXd& chain_N) {
  Signals s;
  s.period_s = motor.period_s;
  s.time_s = motor.time_s;
  s.position_m = load_m;
  s.speed_m_per_s = central_difference(load_m, motor.period_s);
  s.acceleration_m_per_s2 = central_difference(s.speed_m_per_s, motor.period_s);
  s.input_N = chain_N;
  s.other_speed_m_per_s = motor.other_speed_m_per_s;
  s.other_acceleration_m_per_s2 = motor.other_acceleration_m_per_s2;
  find_direction(s, 0);
  s.base.resize(s.size(), static_cast<Index>(kBaseColumns));
  s.base << s.acceleration_m_per_s2, s.speed_m_per_s, s.direction, VectorXd::Ones(s.size());
  return s;
}

}  // namespace

VectorXd LoadSide::of_motor_force(const VectorXd& force_N) const {
  return LoadLaw(baseline, motion.period_s).of_motor_force(force_N);
}

void put_on_chain(Signals& s, const Baseline& baseline, double smoothing_Hz) {
  const LoadLaw law(baseline, s.period_s);
  const ElasticChain& chain = law.chain();
  const VectorXd force = s.input_N;
  const VectorXd chain_N = force - motor_force_N(s, baseline, law.bodies());
  const VectorXd stretch = law.stretch_m(chain_N);
  const Flanks flanks = find_flanks(chain_N);
  auto load = std::make_shared<LoadSide>();
  load->baseline = baseline;
  load->motion = load_signals(
      s, crossed(flanks, s.position_m - stretch - 0.5 * chain.play_m * flanks.side, chain.play_m),
      chain_N);
  const Signals& x = load->motion;
  const double share = chain.load_share;
  s.base.resize(s.size(), static_cast<Index>(kBaseColumns));
  s.base.col(kMass) = x.acceleration_m_per_s2;
  s.base.col(kViscous) =
      share * x.speed_m_per_s + (1 - share) * law.of_motor_force(s.speed_m_per_s);
  s.base.col(kCoulomb) = share * x.direction + (1 - share) * law.of_motor_force(s.direction);
  s.base.col(kBias).setOnes();
  VectorXd left = chain_N - law.inertial_N(x.position_m);
  for (Index i = 0; i < s.size(); ++i) {
    left[i] -= x.direction[i] * law.bodies().load_dry_N({x.position_m[i], x.speed_m_per_s[i]});
  }
  const double k = chain.stiffness_N_per_m;
  const VectorXd by_spring = law.stretch_m(k * stretch);
  load->by_chain.resize(s.size(), 2);
  load->by_chain << law.inertial_N(by_spring) / (1 + baseline.read[kStiffness]),
      law.inertial_N(stretch - by_spring) / (1 + baseline.read[kDamping]);
  load->by_play = -0.5 * law.inertial_N(flanks.side);
  load->by_scale = law.inertial_N(s.position_m) +
                   law.of_motor_force(chain.motor_kg * s.acceleration_m_per_s2 +
                                      (1 - share) * baseline.at[kViscous] * s.speed_m_per_s);
  load->by_gain = law.of_motor_force(force) - left;
  load->known = known_law(s, x, smoothing_Hz);
  s.base = load->known.asDiagonal() * s.base;
  const VectorXd read =
      load->by_chain * baseline.read.head<2>() + load->by_play * baseline.read[kPlay];
  s.input_N = load->known.cwiseProduct(left + read) + s.base * baseline.at;
  s.known_N = force - s.input_N;
  s.load = std::move(load);
}

VectorXd force_for_motion_N(const Signals& s, const Baseline& baseline) {
  const TwoBodies bodies(baseline.model, baseline.at);
  VectorXd force = motor_force_N(s, baseline, bodies);
  return force +
         follow_motor(baseline.model, baseline.at, s.position_m, s.speed_m_per_s, s.period_s);
}

}  // namespace towbench::harness::diagnose
