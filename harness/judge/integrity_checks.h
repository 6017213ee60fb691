// Whether a run may be judged at all. Each of these fails closed: what is not shown to be right
// makes the run INVALID, however good its numbers look.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "harness/checks/check.h"
#include "harness/metrics/run_data.h"

namespace towbench::harness {

// What the run should have left behind.
struct ExpectedRecord {
  core::Nanoseconds control_period_ns = 0;
  core::Nanoseconds exchange_ns = 0;
  core::Nanoseconds end_ns = 0;      // virtual time of the last exchange
  std::uint64_t rows_lost = 0;       // as the controller counts them
  std::size_t scheduled_events = 0;  // whose time came before the end
  std::size_t unreached_events = 0;  // whose time did not
  bool writes_succeeded = true;
};

// A sensor that the rig has.
struct ExpectedSensor {
  std::string file;
  core::Nanoseconds period_ns = 0;
  core::Nanoseconds late_ns = 0;  // its rows are stamped so long after what they show
};

// log.csv: a row each control period from the first to the end, none lost, none torn.
[[nodiscard]] Check check_log_complete(const RunData& data, const ExpectedRecord& expected);
// truth.csv: a row each exchange up to the end.
[[nodiscard]] Check check_truth_complete(const RunData& data, const ExpectedRecord& expected);
// The sensor's file: a sample each period up to the end.
[[nodiscard]] Check check_sensor_complete(const RunData& data, const ExpectedRecord& expected,
                                          const ExpectedSensor& sensor);
// Every axis that really moved was seen moving, and some axis was: an edge-class run without an
// edge proves nothing (RUN-3).
[[nodiscard]] Check check_edges_seen(const RunData& data);
// The machine stands when the record ends: what it did later was judged by nobody.
[[nodiscard]] Check check_comes_to_rest(const RunData& data);
// Every event of the experiment took place.
[[nodiscard]] Check check_events_fired(const RunData& data, const ExpectedRecord& expected);

}  // namespace towbench::harness
