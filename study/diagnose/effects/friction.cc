// Friction that grows or leans with speed or load; laws of 3.2.2 of the thesis and their kin.
#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::MatrixXd;

// C+ for v > 0, C- for v < 0:  C sgn v + dC |sgn v|.
MatrixXd coulomb_asymmetry(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.direction.cwiseAbs();
}

// B+ v for v > 0, B- v for v < 0:  B v + dB |v|.
MatrixXd viscous_asymmetry(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.speed_m_per_s.cwiseAbs();
}

// D |v| v, (3.7).
MatrixXd quadratic_drag(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.speed_m_per_s.cwiseProduct(s.speed_m_per_s.cwiseAbs());
}

MatrixXd cubic_viscous(const Signals& s, const Context& /*c*/, std::span<const double>) {
  return s.speed_m_per_s.array().cube().matrix();
}

// mu |transmitted force| sgn v: gears and guides bind under load.
MatrixXd load_dependent_friction(const Signals& s, const Context& c, std::span<const double>) {
  return c.model_force_N(s).cwiseAbs().cwiseProduct(s.direction);
}

}  // namespace

void add_friction_effects(Library& library) {
  library.push_back({.name = "coulomb_asymmetry",
                     .cause = "dry friction that differs between the two directions",
                     .coefficients = {"half_difference_N"},
                     .acts_on = ActsOn::kBoth,
                     .needs = "motion in both directions",
                     .grid = no_scale,
                     .columns = coulomb_asymmetry});
  library.push_back({.name = "viscous_asymmetry",
                     .cause = "viscous friction that differs between the two directions",
                     .coefficients = {"half_difference_N_s_per_m"},
                     .acts_on = ActsOn::kBoth,
                     .needs = "both directions, each at two or more speeds",
                     .grid = no_scale,
                     .columns = viscous_asymmetry});
  library.push_back({.name = "quadratic_drag",
                     .cause = "drag growing with the square of speed",
                     .coefficients = {"drag_N_s2_per_m2"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kLoad,
                     .needs = "steady speeds up to the highest used",
                     .grid = no_scale,
                     .columns = quadratic_drag});
  library.push_back({.name = "cubic_viscous",
                     .cause = "friction growing with the cube of speed",
                     .coefficients = {"coefficient_N_s3_per_m3"},
                     .acts_on = ActsOn::kLoad,
                     .needs = "steady speeds up to the highest used",
                     .grid = no_scale,
                     .columns = cubic_viscous});
  library.push_back({.name = "load_dependent_friction",
                     .cause = "friction growing with the transmitted force",
                     .coefficients = {"friction_per_load_ratio"},
                     .first_is_positive = true,
                     .acts_on = ActsOn::kLoad,
                     .needs = "accelerating and coasting at the same speed",
                     .grid = no_scale,
                     .columns = load_dependent_friction});
}

}  // namespace towbench::harness::diagnose
