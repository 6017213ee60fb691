// The signals and events of a run that a formula may name, and a run as a trace.
//
// Samples are the rows of log.csv. Of truth.csv each takes the last row that is not later.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/metrics/run_data.h"
#include "harness/signal_logic/formula_text.h"
#include "harness/signal_logic/trace.h"

namespace towbench::harness {

struct RunSignal {
  std::string_view name;    // an axis before it: y_error
  std::string_view unit;    // SI, "%" or "1"
  std::string_view column;  // an axis before it; empty: computed here
  bool of_truth = false;
  std::string_view meaning;
};
[[nodiscard]] std::span<const RunSignal> run_signals() noexcept;

struct RunEventName {
  std::string name;
  std::string meaning;
  core::Axis axis = core::kFirstAxis;  // of an end-stop's
};
[[nodiscard]] std::span<const RunEventName> run_event_names();

[[nodiscard]] Vocabulary run_vocabulary(std::vector<std::string> windows);

// In the order of run_vocabulary().
[[nodiscard]] Trace trace_of(const RunData& data, std::map<std::string, TraceWindow> windows);

}  // namespace towbench::harness
