// Masses that are not where the rigid model has them.
#include <cmath>
#include <numbers>

#include "harness/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd added_mass(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.acceleration_m_per_s2;
}

// (3.37): the load follows the motor through spring and damper,
//   H(s) = (2 z w s + w^2) / (s^2 + 2 z w s + w^2),  w: the carriage against a held motor,
// so the motor feels M_load (H - 1) a more than the rigid model says. Tustin's rule.
MatrixXd chain_elasticity(const Signals& s, const Context& /*c*/, std::span<const double> scale) {
  const double w = 2 * std::numbers::pi * scale[0];
  const double z = scale[1];
  const double k = 2 / s.period_s;
  const double d = 2 * z * w * k;
  const double a0 = k * k + d + w * w;
  const double a1 = 2 * (w * w - k * k) / a0;
  const double a2 = (k * k - d + w * w) / a0;
  const double b0 = (d + w * w) / a0;
  const double b1 = 2 * w * w / a0;
  const double b2 = (w * w - d) / a0;
  const VectorXd& a = s.acceleration_m_per_s2;
  VectorXd column(s.size());
  double x1 = a[0];
  double x2 = a[0];
  double y1 = a[0];
  double y2 = a[0];
  for (Index i = 0; i < s.size(); ++i) {
    const double y = b0 * a[i] + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
    column[i] = y - a[i];
    x2 = x1;
    x1 = a[i];
    y2 = y1;
    y1 = y;
  }
  return column;
}

std::vector<Scales> mode_grid(const Context& c) {
  std::vector<Scales> grid;
  for (const double frequency : {3.0, 4.5, 6.5, 9.0, 13.0, 19.0, 28.0, 40.0}) {
    if (frequency > 1.5 * c.cutoff_Hz) {
      break;
    }
    grid.push_back({frequency, 0.03});
    grid.push_back({frequency, 0.12});
  }
  return grid;
}

// The other axis's acceleration and speed leak into this one (against MACS-A-6).
MatrixXd cross_axis_coupling(const Signals& s, const Context& /*c*/, std::span<const double>) {
  MatrixXd columns(s.size(), 2);
  if (s.other_speed_m_per_s.size() != s.size()) {
    columns.setZero();
    return columns;
  }
  columns.col(0) = s.other_acceleration_m_per_s2;
  columns.col(1) = s.other_speed_m_per_s;
  return columns;
}

}  // namespace

void add_mechanical_effects(Library& library) {
  library.push_back({.name = "added_mass",
                     .cause = "mass that the model does not carry",
                     .coefficients = {"mass_kg"},
                     .needs = "a known mass to compare with",
                     .grid = no_scale,
                     .columns = added_mass});
  library.push_back({.name = "chain_elasticity",
                     .cause = "an elastic chain between motor and load",
                     .coefficients = {"load_mass_kg"},
                     .scales = {"held_motor_frequency_Hz", "damping_ratio"},
                     .first_is_positive = true,
                     .needs = "accelerations fast enough to excite it, finely resolved",
                     .grid = mode_grid,
                     .columns = chain_elasticity});
  library.push_back({.name = "cross_axis_coupling",
                     .cause = "forces from the other axis's motion",
                     .coefficients = {"mass_kg", "viscous_N_s_per_m"},
                     .needs = "a log that has the other axis, moving",
                     .grid = no_scale,
                     .columns = cross_axis_coupling});
}

}  // namespace towbench::harness::diagnose
