// PID gains from an identified model (thesis 4.2, "model-based"): dominant pole placement on the
// axis with its elastic transmission.
//
//   G(s) = (J_l s^2 + c s + k) / [(J_m s^2 + (B + c) s + k)(J_l s^2 + c s + k) - (c s + k)^2]
//   L(s) = (K_P + K_I/s + K_D s) G(s) exp(-s T_d),   1 + L(s_i) = 0
//
// at s_1,2 = w_0 (-zeta +- i sqrt(1 - zeta^2)) and s_3 = -w_0: three linear equations in the three
// gains (Persson, Astrom 1993, "PID control revisited"). The transmission's pair goes where it
// goes, so w_0 is the largest whose loop keeps a largest sensitivity M_s = max |1/(1 + L)| (Astrom,
// Hagglund 2006: 1.2 to 2.0) and is stable by the eigenvalues of the sampled loop. A motor that is
// held stiffly leaves the carriage to swing undamped: where the placed poles are to be the slowest,
// so that the carriage comes to rest with the motor, the loop is an order softer.
//
// Friction is not in it: the loop is tuned on what is left when the axis moves.
#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace towbench::study::identify {

// At the motor's shaft, SI.
struct TwoMassAxis {
  double inertia_kg_m2 = 0;         // J, carriage included
  double rotor_inertia_kg_m2 = 0;   // J_m, 0 < J_m < J
  double viscous_Nm_s_per_rad = 0;  // B, at the motor
  double resonance_Hz = 0;          // free-free
  double damping_ratio = 0;         // of that mode
};

// A torque begins one period T > 0 after its sample; the hold adds T/2, the speed's difference T/2
// to K_D: T_d = 1.5 T, and 2 T of K_D.
struct SampledLoop {
  double period_s = 1e-3;
};

struct LoopGains {
  double proportional_Nm_per_rad = 0;
  double integral_Nm_per_rad_s = 0;
  double derivative_Nm_s_per_rad = 0;
};

struct LoopDemands {
  double damping_ratio = 0.7;        // zeta of the placed pair, 0 to 1
  double largest_sensitivity = 2.0;  // > 1
  bool dominant = false;             // no pole decays slower than the placed pair
};

struct PlacedLoop {
  LoopGains gains;
  double frequency_rad_per_s = 0;  // w_0
  double largest_sensitivity = 0;  // M_s
  double slowest_decay_per_s = 0;  // of the sampled loop's poles
};

// The three gains for one w_0, or none where one would be negative.
[[nodiscard]] std::optional<LoopGains> place_poles(const TwoMassAxis& axis, const SampledLoop& loop,
                                                   double frequency_rad_per_s,
                                                   double damping_ratio);

// Poles of the sampled loop as s = ln(z)/T, in 1/s, the integral's and the delay's included.
[[nodiscard]] std::vector<std::complex<double>> sampled_poles(const TwoMassAxis& axis,
                                                              const SampledLoop& loop,
                                                              const LoopGains& gains);

// M_s over 1 rad/s up to half the sampling rate.
[[nodiscard]] double largest_sensitivity(const TwoMassAxis& axis, const SampledLoop& loop,
                                         const LoopGains& gains);

// The fastest loop that meets the demands, or none.
[[nodiscard]] std::optional<PlacedLoop> fastest_loop(const TwoMassAxis& axis,
                                                     const SampledLoop& loop,
                                                     const LoopDemands& demands);

}  // namespace towbench::study::identify
