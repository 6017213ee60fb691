// What can be known to be impossible before anything moves, each in one sentence. Empty: nothing.
#pragma once

#include <string>

#include "study/procedures/tow/tow_loads.h"

namespace towbench::study::procedures {

// Above what controller or supply allow. The voltage a motor needs at a speed is K_T w + R i, with
// i from what the controller believes of friction, inertia and K_T, and `drag_N` on top.
[[nodiscard]] std::string too_fast(const Machine& machine, core::Axis axis, double speed_m_per_s,
                                   double acceleration_m_per_s2, double drag_N = 0);

// Outside the controller's soft limits.
[[nodiscard]] std::string no_travel(const Machine& machine, core::Axis axis, double from_m,
                                    double to_m);

// A trapezoid whose steady part is shorter than `steady_s`.
[[nodiscard]] std::string too_short(double distance_m, double speed_m_per_s, double acceleration_s,
                                    double smooth_s, double steady_s);

// No sensor, no such axis, or a load that should be in the water and is not.
[[nodiscard]] std::string no_force_sensor(const Machine& machine);
[[nodiscard]] std::string no_axis(const Machine& machine, core::Axis axis);
[[nodiscard]] std::string not_in_water(const TowLoads& loads, const Load& load);

}  // namespace towbench::study::procedures
