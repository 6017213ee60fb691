// Means of columns over stretches of a recording, with what they are worth.
#pragma once

#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct Mean {
  double value = 0;
  double standard_error = 0;  // of the mean, from ten blocks
};

// Rows [from, to) of a column. Fewer than 20 rows: no standard error can be told, it is infinite.
[[nodiscard]] Mean mean_of(const std::vector<double>& column, std::size_t from, std::size_t to);

// Rows [from, to) weighed by a raised cosine, which a swing of two periods or more does not get
// through (Harris 1978). How sure it is only its likes can tell: the standard error is left 0.
[[nodiscard]] Mean smooth_mean_of(const std::vector<double>& column, std::size_t from,
                                  std::size_t to);

// The first row at or after a time.
[[nodiscard]] std::size_t row_at(const Recording& data, double time_s);

}  // namespace towbench::study::identify
