// An axis with an elastic chain, read from its motor.
//
// What the motor is given beyond its own inertia and friction pulls the chain, so the log shows the
// chain's force, its stretch, and with it where the load is, whatever the load did before:
//   F_chain = F - m a - friction_m(v) - b,  s = F_chain / (k + d D),  x = q - s - play/2 sgn
//   F_chain
// and the load's law is linear in what is sought:
//   F_chain = M x'' + share (B x' + C sgn x') + what the plant file states beyond
// No state is simulated: a load that keeps itself swinging (stick-slip) is as well known as one at
// rest. A force e on the motor appears in that law as L e, L = 1 + (M D^2 + share B D) / (k + d D);
// one on the load as itself.
#pragma once

#include <Eigen/Core>

#include "study/diagnose/signals.h"

namespace towbench::harness::diagnose {

// The load as the chain shows it.
struct LoadSide {
  Signals motion;            // base columns those of a rigid body
  Eigen::VectorXd known;     // 1 where the load's law is known, 0 where a body may stand, between
  Eigen::MatrixXd by_chain;  // of the load's law: per ratio of stiffness, of damping
  Eigen::VectorXd by_play;   // of the load's law: per metre of play
  Eigen::VectorXd by_gain;   // of the load's law: per share by which the amplifier gives less
  Eigen::VectorXd by_scale;  // of the load's law: per share by which the encoder reads short
  Baseline baseline;

  // A force on the motor, as the load's law has it.
  [[nodiscard]] Eigen::VectorXd of_motor_force(const Eigen::VectorXd& force_N) const;
};

// Fills base, known_N and load, makes of the input what the base columns are to make, and takes the
// load's standstill for the axis's. Position, speed, acceleration, direction are there.
void put_on_chain(Signals& signals, const Baseline& baseline, double smoothing_Hz);

// What the motor must be given for a motion, the load following by its own law (two_bodies.h).
[[nodiscard]] Eigen::VectorXd force_for_motion_N(const Signals& motor, const Baseline& baseline);

}  // namespace towbench::harness::diagnose
