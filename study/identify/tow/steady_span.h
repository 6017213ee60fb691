// The stretches of a recording in which an axis follows a reference of constant speed: what a
// trapezoid has between its ramps (4.17), and what every method of chapter 8 averages over.
#pragma once

#include <cstddef>
#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct SteadySpan {
  std::size_t first = 0;
  std::size_t last = 0;      // one past the end
  double speed_m_per_s = 0;  // signed, from the counts at both ends
  double from_m = 0;         // reference at both ends, + towards max
  double to_m = 0;

  [[nodiscard]] std::size_t rows() const noexcept { return last - first; }
  [[nodiscard]] double direction() const noexcept { return speed_m_per_s < 0 ? -1.0 : 1.0; }
};

// In time order. The first `settle_s` of each, in which the transmission still swings, are left
// out; what is then shorter than 0.3 s is no span.
[[nodiscard]] std::vector<SteadySpan> steady_spans(const Recording& recording, core::Axis axis,
                                                   double settle_s);

}  // namespace towbench::study::identify
