#include "emulator/plant/load_side.h"

namespace towbench::emulator {

void apply(const LoadSideParameters& load, AxisParameters& axis) noexcept {
  const double r = axis.output_radius_m / axis.gear_ratio;
  axis.inertia_kg_m2 = load.mass_kg * r * r;
  axis.viscous_friction_Nm_s_per_rad = load.viscous_friction_N_s_per_m * r * r;
  axis.coulomb_friction_Nm = load.coulomb_friction_N * r;
  axis.friction.breakaway_Nm =
      load.breakaway_friction_N > 0 ? load.breakaway_friction_N * r : axis.coulomb_friction_Nm;
  axis.amplifier_gain_A_per_V = load.force_gain_N_per_V * r / axis.torque_constant_Nm_per_A;
}

}  // namespace towbench::emulator
