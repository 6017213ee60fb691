#include "harness/judge/budget_checks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/checks/recorded_axes.h"

namespace towbench::harness {
namespace {

// First control tick in which any axis is driven: by the controller's own state, and by its pins
// where it tells of none.
std::optional<double> first_motion_s(const RunData& data) {
  const auto time_s = data.log.column("time_s");
  const bool tells = !data.log_of(core::kFirstAxis, "state").empty();
  auto first = time_s.size();
  for (const auto axis : recorded_axes(data.limits)) {
    const auto column = data.log_of(axis, tells ? "state" : "duty_pct");
    const auto driven = std::find_if(column.begin(), column.end(), [](double v) { return v != 0; });
    if (driven != column.end()) {
      first = std::min(first, static_cast<std::size_t>(driven - column.begin()));
    }
  }
  return first < time_s.size() ? std::optional(time_s[first]) : std::nullopt;
}

// Distance to the nearer limit over that limit's size, over the other's where it is 0. Negative
// when the limit is broken.
double margin_of(const Budget& budget, double value) {
  const double min_size = budget.min ? std::fabs(*budget.min) : 0;
  const double max_size = budget.max ? std::fabs(*budget.max) : 0;
  const auto relative = [](double distance, double size, double other_size) {
    const double scale = size > 0 ? size : other_size;
    return scale > 0 ? distance / scale : distance;
  };
  double margin = std::numeric_limits<double>::infinity();
  if (budget.min) {
    margin = std::min(margin, relative(value - *budget.min, min_size, max_size));
  }
  if (budget.max) {
    margin = std::min(margin, relative(*budget.max - value, max_size, min_size));
  }
  return margin;
}

}  // namespace

std::vector<ResolvedWindow> resolve_windows(const std::vector<EvaluationWindow>& windows,
                                            const RunData& data) {
  const auto motion_s = first_motion_s(data);
  std::vector<ResolvedWindow> resolved;
  for (const auto& window : windows) {
    const bool from_motion = window.origin == EvaluationWindow::Origin::kMotion;
    const double origin_s = from_motion ? motion_s.value_or(0) : 0;
    // Half a nanosecond of slack, so that a row at the very border belongs to the window however
    // the sum rounds.
    constexpr double kSlack_s = 0.5e-9;
    resolved.push_back({window.name,
                        {origin_s + window.from_s - kSlack_s, origin_s + window.to_s + kSlack_s},
                        !from_motion || motion_s.has_value()});
  }
  return resolved;
}

std::map<std::string, TraceWindow> trace_windows(const std::vector<ResolvedWindow>& windows) {
  std::map<std::string, TraceWindow> found;
  for (const auto& window : windows) {
    if (window.found) {
      found[window.name] = {window.span.from_s, window.span.to_s};
    }
  }
  return found;
}

std::vector<Measurement> measure(const RunData& data, const std::vector<ResolvedWindow>& windows) {
  std::vector<Measurement> measurements;
  for (const auto& window : windows) {
    for (const auto& metric : all_metrics()) {
      if (!is_recorded(data.limits, metric.axis)) {
        continue;
      }
      MetricValue value;
      if (window.found) {
        value = metric.compute(data, metric.axis, window.span);
      }
      measurements.push_back(
          {&metric, window.name, value, data.limits[metric.axis].unit(metric.unit)});
    }
  }
  return measurements;
}

Check judge_budget(const Budget& budget, const std::vector<Measurement>& measurements) {
  Check check;
  check.name = budget.metric;
  check.window = budget.window;
  check.min = budget.min;
  check.max = budget.max;
  check.source = budget.source;
  const auto found =
      std::find_if(measurements.begin(), measurements.end(), [&](const Measurement& measurement) {
        return measurement.metric->name == budget.metric && measurement.window == budget.window;
      });
  if (found == measurements.end()) {
    check.reason = "no such metric over such a window";
    return check;
  }
  check.unit = found->unit;
  check.meaning = found->metric->meaning;
  if (found->value.samples == 0 || !std::isfinite(found->value.value)) {
    check.reason = "the run holds nothing to compute this from";
    return check;
  }
  check.value = found->value.value;
  check.margin = margin_of(budget, *check.value);
  const bool below = budget.min && *check.value < *budget.min;
  const bool above = budget.max && *check.value > *budget.max;
  check.verdict = below || above ? Verdict::kFail : Verdict::kPass;
  if (below || above) {
    check.reason = fmt::format("{:.6g} {} is {} {:.6g}", *check.value, check.unit,
                               below ? "below" : "above", below ? *budget.min : *budget.max);
  }
  return check;
}

}  // namespace towbench::harness
