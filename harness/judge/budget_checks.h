// Every metric over every window, and the budgets judged on them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/checks/check.h"
#include "harness/experiment/experiment.h"
#include "harness/metrics/metric.h"
#include "harness/signal_logic/trace.h"

namespace towbench::harness {

// A window of the experiment, resolved against the run.
struct ResolvedWindow {
  std::string name;
  TimeSpan span;
  bool found = true;  // false: it counts from the first motion, and there was none
};

[[nodiscard]] std::vector<ResolvedWindow> resolve_windows(
    const std::vector<EvaluationWindow>& windows, const RunData& data);

// As formulas see them; those that the run does not have are left out.
[[nodiscard]] std::map<std::string, TraceWindow> trace_windows(
    const std::vector<ResolvedWindow>& windows);

struct Measurement {
  const Metric* metric = nullptr;
  std::string window;
  MetricValue value;
  std::string unit{};  // rad for m where the axis turns
};

[[nodiscard]] std::vector<Measurement> measure(const RunData& data,
                                               const std::vector<ResolvedWindow>& windows);

[[nodiscard]] Check judge_budget(const Budget& budget,
                                 const std::vector<Measurement>& measurements);

}  // namespace towbench::harness
