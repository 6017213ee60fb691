// The one table that all plots of a run draw from: the controller's log, the tracking errors, and
// the emulator's truth and what the sensors said at the log's times.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/axis.h"
#include "harness/report/run_contents.h"

namespace towbench::harness::report {

struct PlotColumn {
  std::string name;            // of log.csv or a sensor's file; or y_error_m, y_carriage_m,
                               // y_carriage_speed_m_per_s, y_carriage_error_m, likewise for x
  std::vector<double> values;  // NaN where there is none
};

struct PlotTable {
  std::vector<PlotColumn> columns;  // the first is time_s, strictly increasing; empty: no log
  std::size_t rows = 0;
  std::size_t source_rows = 0;      // of log.csv
  std::size_t rows_per_bucket = 1;  // above 1: thinned, see thinned()
  // What a position in the machine's frame (truth.csv, limits) becomes in the controller's by
  // adding.
  core::PerAxis<double> frame_offset_m;
  std::vector<std::string> remarks;

  [[nodiscard]] const std::vector<double>* find(std::string_view name) const;
};

// Tracking error, motor side: reference_m - position_m; carriage side: reference_m - carriage_m.
// The carriage is shown in the controller's frame, whose origin is where the two counts agreed when
// the axis last began to follow a reference; edges lost since then show as a carriage error. Both
// errors exist only while the axis follows a reference (log.csv's state is kPosition), since a
// difference from a reference that nobody follows is no tracking error.
[[nodiscard]] PlotTable plot_table(const RunContents& run);

// At most about `max_rows` rows. Every bucket of rows becomes two, which hold each column's
// smallest and largest value in the order in which they occurred: no peak is lost, and a peak moves
// in time by less than a bucket.
[[nodiscard]] PlotTable thinned(const PlotTable& table, std::size_t max_rows);

}  // namespace towbench::harness::report
