// The load-side form of a plant: what a direct linear drive is described by.
//
//   M x'' + b x' + F_C sgn(x') = k v_c
#pragma once

#include "core/parameter.h"
#include "emulator/plant/axis_parameters.h"

namespace towbench::emulator {

struct LoadSideParameters {
  double mass_kg = 0;  // everything that moves, rotor included
  double viscous_friction_N_s_per_m = 0;
  double coulomb_friction_N = 0;
  double breakaway_friction_N = 0;  // 0: as Coulomb friction
  double force_gain_N_per_V = 0;    // per command volt

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("mass_kg", mass_kg, core::above(0.0), "everything that moves, rotor included");
    v.value("viscous_friction_N_s_per_m", viscous_friction_N_s_per_m, core::at_least(0.0),
            "effective viscous friction at the load");
    v.value("coulomb_friction_N", coulomb_friction_N, core::at_least(0.0),
            "effective Coulomb friction at the load");
    v.value("breakaway_friction_N", breakaway_friction_N, core::at_least(0.0),
            "force below which the load sticks; 0: as Coulomb friction");
    v.value("force_gain_N_per_V", force_gain_N_per_V, core::above(0.0),
            "drive force per command volt");
  }
};

// Writes the motor-side equivalents into `axis`, by its own gear ratio, wheel radius and torque
// constant: torque = force R/n, inertia = mass (R/n)^2, (3.39)-(3.41) with the errata of
// docs/reference/constants.md.
void apply(const LoadSideParameters& load, AxisParameters& axis) noexcept;

}  // namespace towbench::emulator
