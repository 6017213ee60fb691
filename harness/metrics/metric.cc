#include "harness/metrics/metric.h"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "harness/fixtures/nearest_key.h"
#include "harness/metrics/motion_metrics.h"
#include "harness/metrics/path_metrics.h"
#include "harness/metrics/safety_metrics.h"
#include "harness/metrics/tracking_metrics.h"

namespace towbench::harness {
namespace {

using Compute = MetricValue (*)(const RunData&, core::Axis, const TimeSpan&);

struct Row {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  Compute compute;
};

constexpr std::array kAxisMetrics{
    Row{"tracking_error_peak_m", "m", "largest |reference - encoder|, motor side",
        tracking_error_peak},
    Row{"tracking_error_rms_m", "m", "RMS of reference - encoder, motor side", tracking_error_rms},
    Row{"tracking_error_mean_m", "m", "mean of reference - encoder, signed", tracking_error_mean},
    Row{"final_error_m", "m", "|reference - encoder| in the last control tick", final_error},
    Row{"overshoot_m", "m", "way beyond the reference's last place, after its last change",
        overshoot},
    Row{"settling_s", "s",
        "from the reference's last change until the encoder stays within 0.1 mm of it",
        settling_time},
    Row{"carriage_error_peak_m", "m", "largest |reference - true carriage|", carriage_error_peak},
    Row{"carriage_error_rms_m", "m", "RMS of reference - true carriage", carriage_error_rms},
    Row{"duty_peak_pct", "%", "largest |duty|", duty_peak},
    Row{"duty_saturated_share", "", "share of the control ticks with the duty at its limit",
        duty_saturated_share},
    Row{"duty_ripple_pct", "%", "RMS of the duty's change from tick to tick", duty_ripple},
    Row{"carriage_speed_peak_m_per_s", "m/s", "largest true speed", carriage_speed_peak},
    Row{"carriage_travel_m", "m", "distance between the true extremes", carriage_travel},
    Row{"edges_total", "", "encoder edges that the decoder saw", edges_total},
    Row{"edges_missed", "", "edges that the plant sent and the decoder did not see", edges_missed},
    Row{"hall_entry_speed_m_per_s", "m/s", "true speed at the hall sensor's edge",
        hall_entry_speed},
    Row{"hall_overrun_m", "m", "way of the carriage beyond the hall sensor's edge", hall_overrun},
    Row{"hall_to_standstill_s", "s", "from the hall sensor's edge to standstill",
        hall_to_standstill_time},
    Row{"hard_end_distance_m", "m", "smallest distance to a hard end", hard_end_distance},
    Row{"hard_end_contacts", "", "contacts with a hard end", hard_end_contacts},
    Row{"hard_end_contact_speed_m_per_s", "m/s", "worst speed of contact, 0 = none",
        hard_end_contact_speed},
    Row{"duty_while_faulted_pct", "%", "largest |duty| while latched", duty_while_faulted},
};

constexpr std::array kMachineMetrics{
    Row{"path_error_peak_m", "m", "largest distance from the reference path, motor side",
        path_error_peak},
    Row{"carriage_path_error_peak_m", "m", "largest distance of the carriage from the path",
        carriage_path_error_peak},
    Row{"kill_to_zero_duty_s", "s", "from the kill switch's edge to zero duty on the wire",
        kill_to_zero_duty},
    Row{"fault_number", "", "first fault latched, 0 = none", fault_number},
    Row{"fault_at_end", "", "fault latched in the last row, 0 = none", fault_at_end},
};

std::vector<Metric> build() {
  std::vector<Metric> metrics;
  for (const auto axis : core::kAllAxes) {
    for (const auto& row : kAxisMetrics) {
      metrics.push_back({fmt::format("{}_{}", core::name_of(axis), row.name), std::string(row.unit),
                         std::string(row.meaning), axis, row.compute});
    }
  }
  for (const auto& row : kMachineMetrics) {
    metrics.push_back({std::string(row.name), std::string(row.unit), std::string(row.meaning),
                       core::kFirstAxis, row.compute});
  }
  return metrics;
}

}  // namespace

std::span<const Metric> all_metrics() {
  static const std::vector<Metric> kMetrics = build();
  return kMetrics;
}

const Metric* find_metric(std::string_view name) {
  for (const auto& metric : all_metrics()) {
    if (metric.name == name) {
      return &metric;
    }
  }
  return nullptr;
}

std::string suggest_metric(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& metric : all_metrics()) {
    names.push_back(metric.name);
  }
  const std::string near = nearest_key(name, names);
  return near.empty() ? "a metric of `towbench list --metrics`"
                      : fmt::format("did you mean {}?", near);
}

}  // namespace towbench::harness
