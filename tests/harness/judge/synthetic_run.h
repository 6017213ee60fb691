// Runs whose metrics are known in closed form: no controller, no plant, only columns.
#pragma once

#include <fstream>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "harness/metrics/run_data.h"
#include "harness/record/log_columns.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {

class SyntheticRun {
 public:
  using LogRow = std::function<void(double time_s, bbmc::TelemetryRow& row)>;
  using Truth = std::function<void(double time_s, emulator::TruthRow& row)>;

  // Rows each `period_ns` from 0 to `end_ns`, both files; truth has none at 0, as the bench.
  void write(core::Nanoseconds period_ns, core::Nanoseconds end_ns, const LogRow& log,
             const Truth& truth) {
    CsvWriter log_csv(folder() / "log.csv", log_header());
    CsvWriter truth_csv(folder() / "truth.csv", truth_header());
    for (core::Nanoseconds now_ns = 0; now_ns <= end_ns; now_ns += period_ns) {
      bbmc::TelemetryRow row;
      row.time_ns = now_ns;
      log(core::seconds(now_ns), row);
      write_log_row(log_csv, row);
      if (now_ns > 0) {
        emulator::TruthRow truth_row;
        truth_row.time_ns = now_ns;
        truth(core::seconds(now_ns), truth_row);
        write_truth_row(truth_csv, truth_row);
      }
    }
  }

  void event(const std::string& line) { events_ += line + "\n"; }

  [[nodiscard]] RunData load() {
    files_.write("events.jsonl", events_);
    core::PerAxis<AxisLimits> limits;
    limits[core::Axis::kY] = {.hall_min_m = 0.0,
                              .hall_max_m = 3.9,
                              .hard_min_m = -0.1,
                              .hard_max_m = 4.0,
                              .metres_per_count = 1e-6};
    limits[core::Axis::kX] = limits[core::Axis::kY];
    for (const auto further : core::kFurtherAxes) {
      limits[further].exists = false;
    }
    return load_run_data(folder(), limits);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return files_.folder(); }

 private:
  TemporaryFixtures files_;
  std::string events_;
};

}  // namespace towbench::harness
