// What a user waits for: an experiment from fixture to records on disk, both axes, controller,
// plant, log.csv, truth.csv and timing.csv, in one process. Beside it the cost of one log row.
//
// lockstep_loop (harness_lockstep_loop.cc) is the same without records.
#include <filesystem>

#include <benchmark/benchmark.h>

#include "harness/record/log_columns.h"
#include "harness/run/experiment_run.h"

namespace {

using namespace towbench;

// Times the loop by its own clock: judging is not part of it.
void recorded_circle(benchmark::State& state) {
  const auto fixture = harness::load_experiment("fixtures/experiments/circle.toml");
  harness::RunOptions options;
  options.out = std::filesystem::temp_directory_path() / "towbench-benchmark";
  double simulated_s = 0;
  double wall_s = 0;
  for (auto _ : state) {
    const auto run = harness::run_experiment(fixture, options);
    state.SetIterationTime(run.outcome.wall_time_s);
    simulated_s += core::seconds(run.outcome.end_ns);
    wall_s += run.outcome.wall_time_s;
    std::filesystem::remove_all(run.folder);
  }
  state.counters["times_real_time"] = simulated_s / wall_s;
}
BENCHMARK(recorded_circle)->Unit(benchmark::kMillisecond)->UseManualTime();

void log_row(benchmark::State& state) {
  harness::CsvWriter csv("/dev/null", harness::log_header());
  bbmc::TelemetryRow row;
  double drift = 1.0 / 3.0;
  for (auto _ : state) {
    row.time_ns += core::kNanosecondsPerMillisecond;
    for (auto& axis : row.axes) {
      drift += 1e-7;
      axis.reference_m = drift;
      axis.reference_velocity_m_per_s = drift * 0.4;
      axis.count += 178;
      axis.position_m = drift * 0.99;
      axis.velocity_m_per_s = drift * 0.41;
      axis.duty_pct = 12.3;
      axis.edges = 178;
    }
    harness::write_log_row(csv, row);
  }
}
BENCHMARK(log_row);

}  // namespace
