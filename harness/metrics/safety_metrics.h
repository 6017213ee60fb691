// What happened at the ends and at the kill switch, from truth.csv and events.jsonl.
#pragma once

#include "harness/metrics/metric.h"

namespace towbench::harness {

// How far the carriage still runs towards the end after the edge of its hall sensor; the first edge
// in the span. No sample when no sensor of the axis operated.
MetricValue hall_overrun(const RunData& data, core::Axis axis, const TimeSpan& span);
// True carriage speed at that edge.
MetricValue hall_entry_speed(const RunData& data, core::Axis axis, const TimeSpan& span);
// From that edge until the carriage turns or stands: slower than 1 mm/s for the first time.
MetricValue hall_to_standstill_time(const RunData& data, core::Axis axis, const TimeSpan& span);
// Smallest distance between carriage and hard end; negative when it is pressed into it.
MetricValue hard_end_distance(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue hard_end_contacts(const RunData& data, core::Axis axis, const TimeSpan& span);
// Worst speed of contact; 0 when there was none.
MetricValue hard_end_contact_speed(const RunData& data, core::Axis axis, const TimeSpan& span);
// From the edge of the kill switch to the message that leaves both axes without duty, as it crossed
// the wire. No sample unless the plant's command is then zero in every row until the switch is
// released.
MetricValue kill_to_zero_duty(const RunData& data, core::Axis axis, const TimeSpan& span);
// Largest |duty| in ticks in which the axis is latched in a fault: any but 0 is re-energising.
MetricValue duty_while_faulted(const RunData& data, core::Axis axis, const TimeSpan& span);
// Number of the first fault latched in the span, 0 = none; and of the one in its last row.
MetricValue fault_number(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue fault_at_end(const RunData& data, core::Axis axis, const TimeSpan& span);

}  // namespace towbench::harness
