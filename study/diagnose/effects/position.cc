// Forces and friction that depend on where the carriage is, (3.34) and (4.2).
#include <cmath>
#include <numbers>

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kShapes = 4;

// cos(k pi x), k = 1..4, over the stroke: smooth shapes without a mean.
MatrixXd shapes(const Signals& s, const Context& c) {
  const ArrayXd x = (s.position_m.array() - c.stroke_min_m) / (c.stroke_max_m - c.stroke_min_m);
  MatrixXd columns(s.size(), kShapes);
  for (Index k = 0; k < kShapes; ++k) {
    columns.col(k) = (static_cast<double>(k + 1) * std::numbers::pi * x).cos();
  }
  return columns;
}

// The same force in both directions.
MatrixXd position_force(const Signals& s, const Context& c, std::span<const double>) {
  return shapes(s, c);
}

MatrixXd cable_spring(const Signals& s, const Context& c, std::span<const double>) {
  return (s.position_m.array() - 0.5 * (c.stroke_min_m + c.stroke_max_m)).matrix();
}

// tau_P inside the sign function: it always brakes.
MatrixXd position_friction(const Signals& s, const Context& c, std::span<const double>) {
  return shapes(s, c).array().colwise() * s.direction.array();
}

MatrixXd position_viscous(const Signals& s, const Context& c, std::span<const double>) {
  return shapes(s, c).array().colwise() * s.speed_m_per_s.array();
}

}  // namespace

void add_position_effects(Library& library) {
  const std::string both = "the same stretch in both directions, at two speeds";
  const std::vector<std::string> newtons{"cos1_N", "cos2_N", "cos3_N", "cos4_N"};
  const std::vector<std::string> viscous{"cos1_N_s_per_m", "cos2_N_s_per_m", "cos3_N_s_per_m",
                                         "cos4_N_s_per_m"};
  library.push_back({.name = "position_force",
                     .cause = "a force that depends on position, the same in both directions",
                     .coefficients = newtons,
                     .shares_mean_with = kBias,
                     .acts_on = ActsOn::kLoad,
                     .needs = both,
                     .grid = no_scale,
                     .columns = position_force});
  library.push_back({.name = "cable_spring",
                     .cause = "a force growing with position, as a cable or a tilt change makes",
                     .coefficients = {"stiffness_N_per_m"},
                     .shares_mean_with = kBias,
                     .acts_on = ActsOn::kLoad,
                     .needs = both,
                     .grid = no_scale,
                     .columns = cable_spring});
  library.push_back({.name = "position_friction",
                     .cause = "dry friction that depends on position",
                     .coefficients = newtons,
                     .shares_mean_with = kCoulomb,
                     .acts_on = ActsOn::kLoad,
                     .needs = both,
                     .grid = no_scale,
                     .columns = position_friction});
  library.push_back({.name = "position_viscous",
                     .cause = "viscous friction that depends on position",
                     .coefficients = viscous,
                     .shares_mean_with = kViscous,
                     .acts_on = ActsOn::kLoad,
                     .needs = both,
                     .grid = no_scale,
                     .columns = position_viscous});
}

}  // namespace towbench::harness::diagnose
