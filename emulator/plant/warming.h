// Friction that falls as it warms: a first-order store of what dry friction dissipates.
//
//   W' = (P / P_full - W) / T,   P = f_m |w| + f_c |v|, sliding bodies only
//   level = (1 - depth min(W, 1)) * cold level      Coulomb, break-away and Stribeck parts
//
// Not in the thesis, which only says that friction varies with ambient factors (3.3.2);
// the effect thermal_drift of docs/theory/diagnosis.md.
#pragma once

#include <cmath>

#include "emulator/plant/situation.h"

namespace towbench::emulator {

// Over a piece of motion at the friction that is held.
[[nodiscard]] inline double dissipated_by_dry_friction_J(const Situation& s, double travel_rad,
                                                         double travel_m) noexcept {
  const double motor_J = s.regime.motor_direction * s.motor_friction_Nm * travel_rad;
  const double carriage_J = s.regime.carriage_direction * s.carriage_friction_N * travel_m;
  return motor_J + carriage_J;
}

// By the trapezoidal rule.
[[nodiscard]] inline double warmed(const FrictionWarming& law, double warmth, double dissipated_J,
                                   double duration_s) noexcept {
  const double half = 0.5 * duration_s / law.time_constant_s;
  const double gain = dissipated_J / (law.full_power_W * law.time_constant_s);
  return (warmth * (1.0 - half) + gain) / (1.0 + half);
}

[[nodiscard]] inline double level_scale(const FrictionWarming& law, double warmth) noexcept {
  return 1.0 - law.depth * (warmth < 1.0 ? warmth : 1.0);
}

}  // namespace towbench::emulator
