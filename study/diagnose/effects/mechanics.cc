// Masses that are not where the rigid model has them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/diagnose/effect.h"
#include "study/diagnose/elastic_axis.h"
#include "study/diagnose/fine_motion.h"
#include "study/diagnose/two_bodies.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd added_mass(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.base.col(kMass);
}

// A chain that the model states, but otherwise: by its stiffness and its damping.
MatrixXd stated_chain(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.load == nullptr ? MatrixXd::Zero(s.size(), 2) : s.load->by_chain;
}

std::vector<Scales> where_stated(const Context& c) {
  return c.model.elastic() ? std::vector<Scales>{{}} : std::vector<Scales>{};
}

// (H - 1) x by Tustin's rule, for a carriage on spring and damper against a held motor:
//   H(s) = (2 z w s + w^2) / (s^2 + 2 z w s + w^2)
VectorXd through_mode(const VectorXd& x, double period_s, std::span<const double> mode) {
  const double w = 2 * std::numbers::pi * mode[0];
  const double k = 2 / period_s;
  const double d = 2 * mode[1] * w * k;
  const double a0 = k * k + d + w * w;
  const double a1 = 2 * (w * w - k * k) / a0;
  const double a2 = (k * k - d + w * w) / a0;
  const double b0 = (d + w * w) / a0;
  const double b1 = 2 * w * w / a0;
  const double b2 = (w * w - d) / a0;
  VectorXd out(x.size());
  double x1 = x[0];
  double x2 = x[0];
  double y1 = x[0];
  double y2 = x[0];
  for (Index i = 0; i < x.size(); ++i) {
    const double y = b0 * x[i] + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
    out[i] = y - x[i];
    x2 = x1;
    x1 = x[i];
    y2 = y1;
    y1 = y;
  }
  return out;
}

// (3.37): what resists the load, its inertia and its friction, is felt through the chain, so the
// motor feels (H - 1) (M_load a + C_load sgn v) more than the rigid model says.
MatrixXd chain_elasticity(const Signals& s, const Context& c, std::span<const double> mode) {
  MatrixXd columns(s.size(), 2);
  columns.col(0) = through_mode(fine_acceleration_m_per_s2(s, c), s.period_s, mode);
  columns.col(1) = through_mode(s.direction, s.period_s, mode);
  return columns;
}

std::vector<Scales> mode_grid(const Context& c) {
  std::vector<Scales> grid;
  if (c.model.elastic()) {
    return grid;
  }
  for (const double frequency : {3.0, 4.5, 6.5, 9.0, 13.0, 19.0, 28.0, 40.0, 56.0}) {
    if (frequency > 1.5 * c.cutoff_Hz) {
      break;
    }
    grid.push_back({frequency, 0.03});
    grid.push_back({frequency, 0.12});
  }
  return grid;
}

// Play: a flank lets go where the load's own force changes sign, not where the motion does, and
// until the other one touches the motor moves alone. The load, a guessed share of a rigid model, is
// made to follow the measured motor on flanks that are stiff in its band.
MatrixXd backlash(const Signals& s, const Context& c, std::span<const double> scale) {
  constexpr double kFlank_Hz = 50;
  constexpr double kFlankDamping = 0.4;
  constexpr double kFrictionShare = 0.65;
  NominalModel model = c.model;
  const double load_kg = scale[1] * std::max(1e-9, c.theta[kMass]);
  const double w = 2 * std::numbers::pi * kFlank_Hz;
  model.chain = {.motor_kg = c.theta[kMass] - load_kg,
                 .stiffness_N_per_m = load_kg * w * w,
                 .damping_N_s_per_m = 2 * kFlankDamping * load_kg * w,
                 .load_share = kFrictionShare};
  const FineMotion motor = fine_motion(s, c);
  const auto chain_N = [&] {
    return follow_motor(model, c.theta, motor.position_m, motor.speed_m_per_s, s.period_s);
  };
  const VectorXd without = chain_N();
  model.chain.play_m += scale[0];
  return chain_N() - without;
}

// Play in a chain that the model states.
MatrixXd stated_play(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.load == nullptr ? MatrixXd::Zero(s.size(), 1) : MatrixXd(s.load->by_play);
}

// Plays from what the encoder resolves to a twentieth of the stroke.
std::vector<Scales> play_grid(const Context& c) {
  std::vector<Scales> grid;
  const double stroke = c.stroke_max_m - c.stroke_min_m;
  for (double play = std::max({0.25 * c.resolution_m, 1e-6 * stroke, 1e-7});
       play < stroke / 20 && !c.model.elastic(); play *= 2) {
    grid.push_back({play, 0.5});
    grid.push_back({play, 0.8});
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
                     .acts_on = ActsOn::kLoad,
                     .needs = "a known mass to compare with",
                     .grid = no_scale,
                     .columns = added_mass});
  library.push_back({.name = "chain_elasticity",
                     .cause = "an elastic chain between motor and load",
                     .coefficients = {"load_mass_kg", "load_friction_N"},
                     .scales = {"held_motor_frequency_Hz", "damping_ratio"},
                     .first_is_positive = true,
                     .needs = "accelerations fast enough to excite it, finely resolved",
                     .grid = mode_grid,
                     .columns = chain_elasticity});
  library.push_back({.name = "chain_elasticity",
                     .cause = "a chain stiffer or softer, or damped otherwise, than stated",
                     .coefficients = {"relative_stiffness_ratio", "relative_damping_ratio"},
                     .chain_part = kStiffness,
                     .acts_on = ActsOn::kChain,
                     .needs = "accelerations fast enough to excite it, finely resolved",
                     .grid = where_stated,
                     .columns = stated_chain});
  library.push_back({.name = "backlash",
                     .cause = "play: after the load lets go of a flank the motor moves without it",
                     .coefficients = {"agreement_ratio"},
                     .scales = {"play_m", "load_mass_share_ratio"},
                     .first_is_positive = true,
                     .needs = "reversals, or a sensor on the load",
                     .grid = play_grid,
                     .columns = backlash});
  library.push_back({.name = "backlash",
                     .cause = "play: after the load lets go of a flank the motor moves without it",
                     .coefficients = {"play_m"},
                     .first_is_positive = true,
                     .chain_part = kPlay,
                     .acts_on = ActsOn::kChain,
                     .needs = "reversals, or a sensor on the load",
                     .grid = where_stated,
                     .columns = stated_play});
  library.push_back({.name = "cross_axis_coupling",
                     .cause = "forces from the other axis's motion",
                     .coefficients = {"mass_kg", "viscous_N_s_per_m"},
                     .needs = "a log that has the other axis, moving",
                     .grid = no_scale,
                     .columns = cross_axis_coupling});
}

}  // namespace towbench::harness::diagnose
