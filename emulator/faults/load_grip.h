// What takes hold of an axis's load and of nothing else: a spring and a damper, as stiff as the
// load allows that is evaluated once a tick.
//
//   F = -(k (x - x_0) + d v)      held over the tick T = 100 us
//   k = min(5e5 N/m, m / (36 T^2))        d = min(3e3 N s/m, m / (3 T))
//
// Under a force that is held, x' = x + v T + F T^2 / 2m and v' = v + F T / m. With a = k T^2 / m
// and b = d T / m that map has the trace 2 - a/2 - b and the determinant 1 - b + a/2, so that by
// Jury it is stable for a/2 < b < 2. The bounds above are b <= 1/3, of which no tick turns the
// speed round, and a <= b^2 / 4, which is critical damping at b = 1/3: two thirds of the way to
// either limit are left, and a transmission or another load's mass only adds to m. From a speed v
// the load stops within v m / d, which is 3 T v = 0.3 ms v at b = 1/3.
//
// From 0.9 kg on both are the full values; the lighter axis of the tow tank has 0.95 kg.
#pragma once

#include "emulator/plant/axis_parameters.h"

namespace towbench::emulator {

// Of a load that turns: kg m2, N m/rad and N m s/rad.
struct LoadGrip {
  double stiffness_N_per_m = 0;
  double damping_N_s_per_m = 0;
};

// `load_kg` above 0.
[[nodiscard]] LoadGrip grip_on(double load_kg) noexcept;

// What moves with the load for certain: behind an elastic transmission the load alone, with a rigid
// one everything, J/r^2; with the water that comes along.
[[nodiscard]] double gripped_kg(const AxisParameters& axis) noexcept;

}  // namespace towbench::emulator
