// The nominal axes of docs/reference/constants.md as parameters, and idealised ones for closed
// forms.
#pragma once

#include <array>

#include "emulator/plant/axis_plant.h"

namespace towbench::tests {

inline emulator::AxisParameters nominal_y() {
  emulator::AxisParameters y;
  y.friction.position.position_m.assign(std::array{0.0, 1.976, 3.952});
  y.friction.position.friction_Nm.assign(std::array{0.0, 1.6e-3, 0.0});
  return y;
}

inline emulator::AxisParameters nominal_x() {
  emulator::AxisParameters x;
  x.inertia_kg_m2 = 2.0e-6;
  x.rotor_inertia_kg_m2 = 1.3e-6;
  x.viscous_friction_Nm_s_per_rad = 4e-6;
  x.coulomb_friction_Nm = 1.6e-3;
  x.friction.breakaway_Nm = 2.4e-3;
  x.output_radius_m = 0.030;
  x.torque_constant_Nm_per_A = 23.5e-3;
  x.winding.resistance_ohm = 2.3;
  x.winding.inductance_H = 0.24e-3;
  x.elasticity.resonance_Hz = 22.0;
  x.hard_ends.max_m = 505000.0 / 742241.0;
  return x;
}

// No dry friction, no stops.
inline emulator::AxisParameters linear_axis() {
  emulator::AxisParameters axis;
  axis.coulomb_friction_Nm = 0;
  axis.friction.breakaway_Nm = 0;
  axis.hard_ends.fitted = false;
  return axis;
}

// Metres a radian of motor, R/n.
inline double radius_of(const emulator::AxisParameters& axis) {
  return axis.output_radius_m / axis.gear_ratio;
}

// A plant and what it was last told, stepped by the tick.
struct Bench {
  emulator::AxisPlant plant;
  emulator::AxisInput input{.amplifier_enabled = true};
  emulator::MotionSegments segments{};
  double tick_s = 1e-4;

  Bench(const emulator::AxisParameters& axis, double carriage_m, double tick_length_s = 1e-4)
      : plant(axis, carriage_m, tick_length_s), tick_s(tick_length_s) {}

  void tick() { plant.step(input, segments); }
  void run(double duration_s) {
    for (long k = 0; k < static_cast<long>(duration_s / tick_s + 0.5); ++k) {
      tick();
    }
  }
  // Command that asks for this winding current.
  void ask_current(const emulator::AxisParameters& axis, double current_A) {
    input.command_V = current_A / axis.amplifier_gain_A_per_V;
  }
};

}  // namespace towbench::tests
