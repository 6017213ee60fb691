// Where a homing met its switch, read off what the controller was following: at speed once, then
// slowly again, after which it declared where it stands (bbmc/system/homing.h).
#pragma once

#include <cstddef>
#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct SwitchApproach {
  double outward = 1;  // towards max: 1, min: -1
  // The switch closed between each edge row and the next: its motion stops there.
  std::size_t fast_from = 0;  // where the steady run at seeking speed begins
  std::size_t fast_edge = 0;  // == fast_from: it was not sought, the axis stood on the switch
  std::size_t slow_edge = 0;
  std::size_t declared = 0;  // first row in the calibrated frame
  double shift_counts = 0;   // by which the declaration moved the count
};

// In order of time. `slow_m_per_s`: the speed of the approach that counts.
[[nodiscard]] std::vector<SwitchApproach> find_switch_approaches(const Recording& data,
                                                                 core::Axis axis,
                                                                 double slow_m_per_s);

// Middles of the counts of all rows in the frame of the first one: declarations taken back.
[[nodiscard]] std::vector<double> counts_in_one_frame(const Recording& data, core::Axis axis,
                                                      const std::vector<SwitchApproach>& all);

}  // namespace towbench::study::identify
