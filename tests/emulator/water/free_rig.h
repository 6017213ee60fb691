// A rig whose axes are nothing but masses, so that what the water does to them has a closed form.
#pragma once

#include "emulator/rig.h"

namespace towbench::emulator {

inline constexpr double kFreeMass_kg = 6.0;

// Both axes: rigid, no friction, no stops, no supply. Currents do not flow: the drive is disabled.
inline RigParameters free_rig() {
  RigParameters rig;
  for (RigAxisParameters& axis : rig.axes) {
    AxisParameters& p = axis.plant;
    const double r = p.output_radius_m / p.gear_ratio;
    p.inertia_kg_m2 = kFreeMass_kg * r * r;
    p.rotor_inertia_kg_m2 = 0.2 * p.inertia_kg_m2;
    p.viscous_friction_Nm_s_per_rad = 0.0;
    p.coulomb_friction_Nm = 0.0;
    p.friction.breakaway_Nm = 0.0;
    p.elasticity.rigid = true;
    p.hard_ends.fitted = false;
    axis.hall_min.fitted = false;
    axis.hall_max.fitted = false;
  }
  return rig;
}

inline double speed_of(const Rig& rig, core::Axis axis) {
  return rig.truth().axes[axis].carriage_speed_m_per_s;
}
inline double place_of(const Rig& rig, core::Axis axis) {
  return rig.truth().axes[axis].carriage_m;
}

// Pushes until the axes are in motion, then lets go.
inline void set_in_motion(Rig& rig, double y_N, double x_N, int ticks) {
  rig.push_carriage(core::Axis::kY, y_N, rig.now_ns());
  rig.push_carriage(core::Axis::kX, x_N, rig.now_ns());
  for (int i = 0; i < ticks; ++i) {
    rig.step();
  }
  rig.push_carriage(core::Axis::kY, 0.0, rig.now_ns());
  rig.push_carriage(core::Axis::kX, 0.0, rig.now_ns());
}

}  // namespace towbench::emulator
