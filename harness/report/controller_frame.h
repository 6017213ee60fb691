// Where the controller's zero lies on the machine: its count less the true one.
#pragma once

#include <cstddef>
#include <vector>

namespace towbench::harness::report {

// Less than this between two frames is a matter of when the two counts were sampled.
inline constexpr double kFrameTolerance_m = 1e-4;

// Counts, for each row. Taken anew while the axis is idle (its zero may be set then) and where it
// begins to follow a reference; held in between, so that edges lost on the way show.
// `state` is bbmc::AxisMode by number, or null: following throughout.
[[nodiscard]] std::vector<double> count_origins(const std::vector<double>& count,
                                                const std::vector<double>& true_count,
                                                const std::vector<double>* state);

// The row from which on the controller's zero stays as it is when the axis is first driven.
// Positions before it are in another frame.
[[nodiscard]] std::size_t first_row_of_frame(const std::vector<double>& origins,
                                             const std::vector<double>& state,
                                             double metres_per_count);

}  // namespace towbench::harness::report
