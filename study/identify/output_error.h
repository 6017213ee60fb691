// Parameters of the two-mass model by output error: those with which the simulated encoder follows
// the measured one. No speed or acceleration is ever taken from counts, and the input is exact, so
// quantisation and filtering leave no bias (Ljung 1999, ch. 7).
//
//   e_k = [n(t_k) - n(t_k - s)] - [m(t_k) - m(t_k - s)]      n measured, m simulated counts
//
// over a span s: what the model leaves out cannot pile up over the whole run. Minimised by Ceres.
//
// Friction is C + tau_P(x), tau_P piecewise linear between `knots_m`; what is estimated is its
// value at each knot and, on request, where the inner ones stand: the motor remembers for J/B, so a
// bend that is 3 mm off is seen a metre later. Torques scale with K_T K_amp, which encoder and duty
// cannot show; so does the rotor's inertia, which therefore is no number of its data sheet alone.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "study/identify/two_mass_simulation.h"

namespace towbench::study::identify {

struct TwoMassStart {
  emulator::AxisParameters axis;  // documents, and first guesses of what is estimated
  DrivePath path;
  std::vector<double> knots_m{};     // ascending, at least one
  std::vector<double> coulomb_Nm{};  // first guess at each knot; empty: the axis's own
  double knots_known_m = 0;          // standard deviation of an inner knot's place; 0: exact
  // How well the first guess is known, as a standard deviation of its logarithm; 0: not at all.
  double stribeck_known = 0;
  double excess_known = 0;
  double share_known = 0.25;  // of the carriage's share, absolute
  // Of the rotor's inertia, which its data sheet gives, in units of the torques that are known by
  // K_T K_amp: as well as those. A swing of the transmission tells it to 1e-4.
  double rotor_known = 0;
};

struct TwoMassFit {
  emulator::AxisParameters axis;
  DrivePath path;
  std::vector<double> knots_m;
  std::vector<double> coulomb_Nm;  // at each knot
  std::vector<double> coulomb_standard_error_Nm;
  double inertia_standard_error = 0;
  double viscous_standard_error = 0;
  double resonance_standard_error_Hz = 0;
  double damping_standard_error = 0;
  double share_standard_error = 0;
  double rotor_standard_error = 0;
  double common_standard_error_Nm = 0;  // of axis.coulomb_friction_Nm: what is not the place's
  double excess_Nm = 0;                 // break-away above sliding friction
  double excess_standard_error_Nm = 0;
  double stribeck_standard_error = 0;
  double residual_rms_counts = 0;
  std::vector<double> simulated_counts;
  bool converged = false;
  std::string message;
};

[[nodiscard]] TwoMassFit fit_two_mass(const TwoMassStart& start, const Recording& data,
                                      core::Axis axis);

}  // namespace towbench::study::identify
