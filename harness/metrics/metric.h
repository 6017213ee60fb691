// The metrics that a budget may name. One table (metric.cc) lists them all; the laws stand in
// {tracking,safety,path,motion}_metrics.cc.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/axis.h"
#include "harness/metrics/run_data.h"

namespace towbench::harness {

// `samples` = 0 means that the run holds nothing to compute it from: INVALID, never a pass.
struct MetricValue {
  double value = 0;
  std::size_t samples = 0;
};

struct Metric {
  std::string name;
  std::string unit;
  std::string meaning;
  core::Axis axis = core::kFirstAxis;  // ignored by metrics of the whole machine
  MetricValue (*compute)(const RunData& data, core::Axis axis, const TimeSpan& span) = nullptr;
};

// Every metric, per-axis ones once an axis.
[[nodiscard]] std::span<const Metric> all_metrics();
// Null when there is none of that name.
[[nodiscard]] const Metric* find_metric(std::string_view name);
// For an error message: the metric that was probably meant, or where to find the list.
[[nodiscard]] std::string suggest_metric(std::string_view name);

}  // namespace towbench::harness
