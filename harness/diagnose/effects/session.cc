// What changes in the course of a run, and what a count that is lost does to the scale.
#include "harness/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

// Friction that falls as grease warms up: C (1 + k t) sgn v, to first order in the run's length.
MatrixXd thermal_drift(const Signals& s, const Context& c, std::span<const double>) {
  const ArrayXd age = s.time_s.array() / c.duration_s - 0.5;
  return (age * s.direction.array()).matrix();
}

// A constant share of the edges is lost: position, speed and acceleration read small alike.
MatrixXd encoder_count_loss(const Signals& s, const Context& c, std::span<const double>) {
  return c.theta[kMass] * s.acceleration_m_per_s2 + c.theta[kViscous] * s.speed_m_per_s;
}

}  // namespace

void add_session_effects(Library& library) {
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that changes in the course of the run",
                     .coefficients = {"change_over_run_N"},
                     .shares_mean_with = kCoulomb,
                     .needs = "the same motion cold and warm",
                     .grid = no_scale,
                     .columns = thermal_drift});
  library.push_back({.name = "encoder_count_loss",
                     .cause = "an encoder that loses a share of its counts",
                     .coefficients = {"lost_share_ratio"},
                     .needs = "a known distance, or the index pulse",
                     .grid = no_scale,
                     .columns = encoder_count_loss});
}

}  // namespace towbench::harness::diagnose
