// Distance from the path: how far the point (x, y) is from the nearest point of the reference path,
// whatever the time it is reached (the contour error of a circle or a spatial sinusoid).
#pragma once

#include "harness/metrics/metric.h"

namespace towbench::harness {

// Over the control ticks in which both axes follow a reference.
MetricValue path_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span);
// The same for the true carriage.
MetricValue carriage_path_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span);

}  // namespace towbench::harness
