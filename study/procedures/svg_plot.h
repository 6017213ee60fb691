// One figure as a self-contained SVG: axes with round ticks, lines, dots with intervals, a legend.
#pragma once

#include <string>

#include "study/procedures/figure.h"

namespace towbench::study::procedures {

// Points that are not finite break a line. A figure without any finite point says so.
[[nodiscard]] std::string svg_plot(const Figure& figure);

}  // namespace towbench::study::procedures
