// How an axis moved and was driven: duty, speed, travel, edges.
#pragma once

#include "harness/metrics/metric.h"

namespace towbench::harness {

MetricValue duty_peak(const RunData& data, core::Axis axis, const TimeSpan& span);
// Share of the control ticks with the duty at its limit, 0 .. 1.
MetricValue duty_saturated_share(const RunData& data, core::Axis axis, const TimeSpan& span);
// RMS of the duty's change from one control tick to the next.
MetricValue duty_ripple(const RunData& data, core::Axis axis, const TimeSpan& span);
// Of the true carriage.
MetricValue carriage_speed_peak(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue carriage_travel(const RunData& data, core::Axis axis, const TimeSpan& span);
// A and B edges that the controller's decoder saw.
MetricValue edges_total(const RunData& data, core::Axis axis, const TimeSpan& span);
// Edges that the plant sent less those that the decoder saw, from the start of the run to the end
// of the span.
MetricValue edges_missed(const RunData& data, core::Axis axis, const TimeSpan& span);

}  // namespace towbench::harness
