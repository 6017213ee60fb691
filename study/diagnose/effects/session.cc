// What changes in the course of a run, and what a count that is lost does to the scale.
#include <algorithm>
#include <cmath>

#include "study/diagnose/effect.h"
#include "study/diagnose/elastic_axis.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

// Friction that falls as grease warms up: C + dC exp(-t / tau); a straight line where tau is long.
MatrixXd thermal_drift(const Signals& s, const Context& c, std::span<const double> tau) {
  const ArrayXd gone =
      (1 - (-s.time_s.array() / tau[0]).exp()) / (1 - std::exp(-c.duration_s / tau[0]));
  return (-gone * s.direction.array()).matrix();
}

// The same by what heats it: dry friction's work, a first-order store of |v|. It cools again where
// the motion is slow, which an elastic axis's log shows too.
MatrixXd warmed_by_work(const Signals& s, const Context& c, std::span<const double> tau) {
  const double share = s.period_s / tau[0];
  double warmth = 0;
  ArrayXd gone(s.size());
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    warmth += share * (std::abs(s.speed_m_per_s[i]) / c.top_speed_m_per_s - warmth);
    gone[i] = warmth;
  }
  return (-gone / std::max(1e-12, gone.maxCoeff()) * s.direction.array()).matrix();
}

std::vector<Scales> working_grid(const Context& c) {
  if (!c.model.elastic()) {
    return {};
  }
  return {{0.12 * c.duration_s}, {0.3 * c.duration_s}, {0.7 * c.duration_s}, {5 * c.duration_s}};
}

std::vector<Scales> warming_grid(const Context& c) {
  return {{0.12 * c.duration_s}, {0.3 * c.duration_s}, {0.7 * c.duration_s}, {5 * c.duration_s}};
}

// A constant share of the edges is lost: position, speed and acceleration read small alike.
MatrixXd encoder_count_loss(const Signals& s, const Context& c, std::span<const double>) {
  if (s.load != nullptr) {
    return s.load->by_scale;
  }
  return c.theta[kMass] * s.acceleration_m_per_s2 + c.theta[kViscous] * s.speed_m_per_s;
}

}  // namespace

void add_session_effects(Library& library) {
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that changes in the course of the run",
                     .coefficients = {"fall_over_run_N"},
                     .scales = {"time_constant_s"},
                     .shares_mean_with = kCoulomb,
                     .acts_on = ActsOn::kBoth,
                     .needs = "the same motion cold and warm",
                     .grid = warming_grid,
                     .columns = thermal_drift});
  library.push_back({.name = "thermal_drift",
                     .cause = "friction that falls with what it has dissipated",
                     .coefficients = {"largest_fall_N"},
                     .scales = {"time_constant_s"},
                     .shares_mean_with = kCoulomb,
                     .acts_on = ActsOn::kBoth,
                     .needs = "the same motion cold and warm",
                     .grid = working_grid,
                     .columns = warmed_by_work});
  library.push_back({.name = "encoder_count_loss",
                     .cause = "an encoder that loses a share of its counts",
                     .coefficients = {"lost_share_ratio"},
                     .acts_on = ActsOn::kChain,
                     .needs = "a known distance, or the index pulse",
                     .grid = no_scale,
                     .columns = encoder_count_loss});
}

}  // namespace towbench::harness::diagnose
