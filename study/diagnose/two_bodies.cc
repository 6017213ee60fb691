#include "study/diagnose/two_bodies.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/known_terms.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kLeastLoadShare = 0.02;  // of the mass: a fit may ask for less than the motor

}  // namespace

TwoBodies::TwoBodies(const NominalModel& model, const Theta& theta)
    : model_(model), bias_N_(theta[kBias]) {
  const auto part = [&](double share) {
    return Body{0, share * std::max(0.0, theta[kViscous]), share * std::max(0.0, theta[kCoulomb]),
                share * model.breakaway_excess_N};
  };
  const double share = model.chain.load_share;
  load_ = part(share);
  motor_ = part(1 - share);
  motor_.mass_kg = model.chain.motor_kg;
  load_.mass_kg =
      std::max(theta[kMass] - model.chain.motor_kg, kLeastLoadShare * model.chain.motor_kg);
}

TwoBodies::Flank TwoBodies::flank(const Motion& motor, const Motion& load) const noexcept {
  const ElasticChain& chain = model_.chain;
  const double stretch = motor.position_m - load.position_m;
  const double spring = chain.stiffness_N_per_m *
                        (stretch - std::clamp(stretch, -0.5 * chain.play_m, 0.5 * chain.play_m));
  if (chain.play_m > 0) {
    const double damping = chain.damping_N_s_per_m * (motor.speed_m_per_s - load.speed_m_per_s);
    if (spring * (spring + damping) <= 0) {
      return {};
    }
  }
  return {spring, chain.damping_N_s_per_m};
}

double TwoBodies::chain_N(const Motion& motor, const Motion& load) const noexcept {
  const Flank f = flank(motor, load);
  return f.spring_N + f.damper_N_s_per_m * (motor.speed_m_per_s - load.speed_m_per_s);
}

double TwoBodies::dry_N(const Body& body, double speed_m_per_s) const {
  return body.coulomb_N +
         (body.excess_N > 0 ? body.excess_N * stribeck_share(model_, speed_m_per_s) : 0.0);
}

double TwoBodies::position_friction_N(double x_m) const {
  return model_.friction_at_m.empty() ? 0.0
                                      : interpolated(model_.friction_at_m, model_.friction_N, x_m);
}

double TwoBodies::motor_friction_N(double speed_m_per_s, double direction) const {
  return motor_.viscous_N_s_per_m * speed_m_per_s + dry_N(motor_, speed_m_per_s) * direction;
}

void TwoBodies::push(Motion& body, const Body& of, double force_N, double damper, double dry_N,
                     double h_s) {
  const double per_kg = h_s / of.mass_kg;
  const double held = 1 + per_kg * (damper + of.viscous_N_s_per_m);
  const double free = (body.speed_m_per_s + per_kg * force_N) / held;
  const double loss = per_kg * dry_N / held;
  body.speed_m_per_s = std::copysign(std::max(std::abs(free) - loss, 0.0), free);
}

double TwoBodies::load_dry_N(const Motion& load) const {
  return dry_N(load_, load.speed_m_per_s) + position_friction_N(load.position_m);
}

void TwoBodies::step_load(Motion& load, const Motion& motor, double h_s) const {
  load.position_m += 0.5 * h_s * load.speed_m_per_s;
  const Flank f = flank(motor, load);
  const double force = f.spring_N + f.damper_N_s_per_m * motor.speed_m_per_s;
  push(load, load_, force, f.damper_N_s_per_m, load_dry_N(load), h_s);
  load.position_m += 0.5 * h_s * load.speed_m_per_s;
}

void TwoBodies::step(Motion& motor, Motion& load, double on_motor_N, double on_load_N,
                     double h_s) const {
  motor.position_m += 0.5 * h_s * motor.speed_m_per_s;
  load.position_m += 0.5 * h_s * load.speed_m_per_s;
  const Motion motor_midway = motor;
  const Motion load_midway = load;
  const Flank f = flank(motor_midway, load_midway);
  const double spring = f.spring_N;
  const double damper = f.damper_N_s_per_m;
  push(motor, motor_, on_motor_N - bias_N_ - spring + damper * load_midway.speed_m_per_s, damper,
       dry_N(motor_, motor.speed_m_per_s), h_s);
  push(load, load_, on_load_N + spring + damper * motor_midway.speed_m_per_s, damper,
       load_dry_N(load), h_s);
  motor.position_m += 0.5 * h_s * motor.speed_m_per_s;
  load.position_m += 0.5 * h_s * load.speed_m_per_s;
}

Eigen::VectorXd follow_motor(const NominalModel& model, const Theta& theta,
                             const Eigen::VectorXd& motor_m, const Eigen::VectorXd& motor_m_per_s,
                             double period_s) {
  const TwoBodies bodies(model, theta);
  const Eigen::Index n = motor_m.size();
  Eigen::VectorXd chain_N(n);
  Motion load{motor_m[0], motor_m_per_s[0]};
  const auto steps = std::max(1, static_cast<int>(std::ceil(period_s / kLongestStep_s)));
  const double h = period_s / steps;
  for (Eigen::Index k = 0; k < n; ++k) {
    chain_N[k] = bodies.chain_N({motor_m[k], motor_m_per_s[k]}, load);
    const Eigen::Index next = std::min(k + 1, n - 1);
    for (int i = 0; i < steps; ++i) {
      const double w = (i + 0.5) / steps;
      bodies.step_load(load,
                       {(1 - w) * motor_m[k] + w * motor_m[next],
                        (1 - w) * motor_m_per_s[k] + w * motor_m_per_s[next]},
                       h);
    }
  }
  return chain_N;
}

}  // namespace towbench::harness::diagnose
