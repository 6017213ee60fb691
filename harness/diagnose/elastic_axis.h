// The inverse of an axis with an elastic chain: from what the motor did to the force that it took.
//
// The chain is pulled by the measured motor; the load follows by its own law (two_bodies.h), which
// is stable whatever the controller did. So
//   F = m a + friction_m(v) + b + F_chain(load following q)
// needs no twin in closed loop, and what the plant file states of chain, Stribeck friction and
// places that run hard is in it.
#pragma once

#include <Eigen/Core>

#include "harness/diagnose/signals.h"

namespace towbench::harness::diagnose {

struct Followed {
  Eigen::VectorXd load_m;
  Eigen::VectorXd load_m_per_s;
  Eigen::VectorXd chain_N;
};

// The load of `model` with coefficients `theta` while the motor moves as given. It starts beside
// the motor, at its speed. `extra_N` resists it, empty: none.
[[nodiscard]] Followed follow_motor(const NominalModel& model, const Theta& theta,
                                    const Eigen::VectorXd& motor_m,
                                    const Eigen::VectorXd& motor_m_per_s, double period_s,
                                    const Eigen::VectorXd& extra_N);

// The load while the motor does what was measured, and what a force on it makes the chain do.
struct LoadSide {
  Signals motion;            // of the load, its base columns those of a rigid body
  Eigen::MatrixXd by_chain;  // d F / d ln stiffness, d F / d ln damping
  Baseline baseline;
  Eigen::VectorXd motor_m;
  Eigen::VectorXd motor_m_per_s;
  Eigen::VectorXd chain_N;

  // Chain force that overcomes a force which resists the load, small against dry friction: the
  // derivative of the load's law, sticking included.
  [[nodiscard]] Eigen::VectorXd through_chain(const Eigen::VectorXd& force_N) const;
};

// Fills base, known_N and load. Position, speed, acceleration, direction are there.
void put_on_chain(Signals& signals, const Baseline& baseline);

}  // namespace towbench::harness::diagnose
