// Friction near zero speed and after a reversal.
#include <algorithm>
#include <cmath>

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

std::vector<Scales> speed_grid(const Context& c) {
  std::vector<Scales> grid;
  for (const double share : {0.01, 0.02, 0.04, 0.08, 0.15, 0.3}) {
    grid.push_back({share * c.top_speed_m_per_s});
  }
  return grid;
}

// Travel after a reversal: from what the encoder resolves to a twentieth of the stroke.
std::vector<Scales> travel_grid(const Context& c) {
  std::vector<Scales> grid;
  const double stroke = c.stroke_max_m - c.stroke_min_m;
  const double shortest = std::max({4 * c.resolution_m, 1e-4 * stroke, 1e-6});
  for (double travel = shortest; travel < stroke / 20; travel *= 2.2) {
    grid.push_back({travel});
  }
  return grid;
}

// (3.25): (S - C) exp(-(v/v_s)^2) sgn v.
MatrixXd stribeck(const Signals& s, const Context& /*c*/, std::span<const double> scale) {
  const ArrayXd x = s.speed_m_per_s.array() / scale[0];
  return ((-x.square()).exp() * s.direction.array()).matrix();
}

// Friction falls towards zero speed: C (1 - exp(-|v|/v_0)) sgn v, boundary of mixed lubrication.
MatrixXd low_speed_rolloff(const Signals& s, const Context& /*c*/, std::span<const double> scale) {
  const ArrayXd x = s.speed_m_per_s.array().abs() / scale[0];
  return (-(-x).exp() * s.direction.array()).matrix();
}

// Break-away level above Coulomb's, (3.23): felt while leaving standstill, not while coming to it.
// Half of it where the encoder's steps hide which of the two it is: a creeping axis does both.
MatrixXd stiction(const Signals& s, const Context& c, std::span<const double> scale) {
  const ArrayXd x = s.speed_m_per_s.array() / scale[0];
  const ArrayXd faster = s.direction.array() * s.acceleration_m_per_s2.array();
  const double unsure = std::max(1e-9, 2 * c.acceleration_noise_m_per_s2);
  const ArrayXd leaving = 0.5 * (1 + (faster / unsure).tanh());
  return ((-x.square()).exp() * s.direction.array() * leaving).matrix();
}

// The asperities act as a spring: after a reversal friction builds up over a path, Dahl (1968):
// C (1 - 2 exp(-s/s_0)) sgn v.
MatrixXd presliding(const Signals& s, const Context& /*c*/, std::span<const double> scale) {
  const ArrayXd x = s.since_reversal_m.array() / scale[0];
  return (-(-x).exp() * s.direction.array()).matrix();
}

}  // namespace

void add_low_speed_effects(Library& library) {
  const std::string slow = "slow motion through zero speed, repeated";
  library.push_back({.name = "stribeck",
                     .cause = "friction rising towards zero speed (Stribeck)",
                     .coefficients = {"rise_N"},
                     .scales = {"stribeck_speed_m_per_s"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kBoth,
                     .needs = slow,
                     .grid = speed_grid,
                     .columns = stribeck});
  library.push_back({.name = "low_speed_rolloff",
                     .cause = "friction falling towards zero speed",
                     .coefficients = {"fall_N"},
                     .scales = {"speed_scale_m_per_s"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kBoth,
                     .needs = slow,
                     .grid = speed_grid,
                     .columns = low_speed_rolloff});
  library.push_back({.name = "stiction",
                     .cause = "a break-away force above the sliding friction",
                     .coefficients = {"excess_N"},
                     .scales = {"speed_scale_m_per_s"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kBoth,
                     .needs = "many starts from rest, with slow ramps",
                     .grid = speed_grid,
                     .columns = stiction});
  library.push_back({.name = "presliding",
                     .cause = "friction that builds up over a path after each reversal",
                     .coefficients = {"missing_at_reversal_N"},
                     .scales = {"travel_m"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kBoth,
                     .needs = "small reversals at two speeds",
                     .grid = travel_grid,
                     .columns = presliding});
}

}  // namespace towbench::harness::diagnose
