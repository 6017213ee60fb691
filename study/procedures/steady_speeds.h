// The speeds of the torque-speed map, and whether a stretch was run at one.
#pragma once

#include <cstddef>
#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::procedures {

// 1-10 mm/s by 1, 1-10 cm/s by 1, 10-40 cm/s by 10 (EXP-CL-1), in m/s, none above `top`.
[[nodiscard]] std::vector<double> speeds_up_to(double top);

// Whether the axis stuck and slipped between two rows of a stretch at that speed.
[[nodiscard]] bool sticks(const identify::Recording& data, core::Axis axis, std::size_t from,
                          std::size_t to, double speed);

}  // namespace towbench::study::procedures
