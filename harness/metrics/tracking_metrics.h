// Tracking: motor side from log.csv, carriage side from truth.csv (docs/reference/constants.md,
// last erratum: with an elastic transmission both are judged).
//
// Motor side error = unquantised reference - (count + 1/2) x resolution, over the control ticks in
// which the axis follows a reference. Carriage side error = reference - true carriage position,
// with the controller's origin taken from the counts of both sides where the motion begins, so that
// an edge lost on the way counts as an error.
#pragma once

#include "harness/metrics/metric.h"

namespace towbench::harness {

MetricValue tracking_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue tracking_error_rms(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue tracking_error_mean(const RunData& data, core::Axis axis, const TimeSpan& span);
// |reference - encoder| in the last control tick of the span.
MetricValue final_error(const RunData& data, core::Axis axis, const TimeSpan& span);
// Largest way of the encoder beyond the reference's last place, in the direction of its last
// change, from that change on; 0 where it does not come so far.
MetricValue overshoot(const RunData& data, core::Axis axis, const TimeSpan& span);
// From the reference's last change until the encoder stays within 0.1 mm of its last place. No
// sample where it does not within the span.
MetricValue settling_time(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue carriage_error_peak(const RunData& data, core::Axis axis, const TimeSpan& span);
MetricValue carriage_error_rms(const RunData& data, core::Axis axis, const TimeSpan& span);

// One sample of an axis that follows a reference, on the carriage side.
struct CarriageSample {
  std::size_t log_row = 0;
  double carriage_m = 0;  // in the controller's frame
};

// Every control tick of `span` in which the axis follows a reference and a truth row of the same
// time exists.
[[nodiscard]] std::vector<CarriageSample> carriage_samples(const RunData& data, core::Axis axis,
                                                           const TimeSpan& span);

// bbmc::AxisMode::kPosition as log.csv has it.
inline constexpr double kStatePosition = 2;

}  // namespace towbench::harness
