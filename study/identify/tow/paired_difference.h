// What changed between two runs of the same motion: the core of the force sensor method and of the
// motor current difference (8.5), and of the subtractive approach (3.1).
//
// Both runs follow the same reference, so row k of a steady span stands at the same place in both,
// and what depends on the place (friction of the rails) leaves the difference row by row. Each run
// goes there and back: a sensor's constant error has the same sign both ways, drag has not, so half
// the difference of the two directions is free of it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "study/identify/recording.h"
#include "study/identify/tow/drag_law.h"
#include "study/identify/tow/steady_span.h"

namespace towbench::study::identify {

// Rows of a mean's blocks: 0.2 s of them, two periods of the transmission and ten of the sensor's
// memory.
[[nodiscard]] std::size_t block_rows(const Recording& recording) noexcept;

// Mean over both directions of direction x scale x (with - without), at the mean speed. Empty when
// the two recordings have not the same steady spans, both ways.
[[nodiscard]] std::optional<DragPoint> paired_difference(
    const Recording& with, std::span<const double> column_with, const Recording& without,
    std::span<const double> column_without, core::Axis axis, double scale, double settle_s);

// Of one run alone: mean over both directions of direction x scale x column.
[[nodiscard]] std::optional<DragPoint> both_ways(const Recording& recording,
                                                 std::span<const double> column, core::Axis axis,
                                                 double scale, double settle_s);

}  // namespace towbench::study::identify
