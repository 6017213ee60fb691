// What it costs a run at full speed that a panel looks on and may steer: the loop's own time with
// the panel's tap, hand and frames (made twenty times a second on another thread, as for an open
// page) over the loop's time without, in alternation.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include "harness/panel/panel_json.h"

namespace {

using namespace towbench::harness;
namespace fs = std::filesystem;

fs::path temporary_folder() {
  auto pattern = (fs::temp_directory_path() / "towbench-panel-XXXXXX").string();
  return mkdtemp(pattern.data());
}

double plain_s(const ExperimentFixture& fixture, const fs::path& out) {
  RunOptions options;
  options.out = out;
  return run_experiment(fixture, options).outcome.wall_time_s;
}

double watched_s(Session& session, FrameMaker& frames) {
  session.start({.experiment = "circle", .pace = {.speed = 0, .paused = false}});
  while (session.state().phase != Session::Phase::kOver) {
    benchmark::DoNotOptimize(frames.next());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::ifstream stream(session.runs() / session.state().folder / "result.json");
  return nlohmann::json::parse(stream).at("wall_time_s").get<double>();
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void panel_over_plain(benchmark::State& state) {
  const auto out = temporary_folder();
  const auto fixture = load_experiment("fixtures/experiments/circle.toml");
  const auto session = std::make_unique<Session>(out);
  FrameMaker frames(*session);
  std::vector<double> plain;
  std::vector<double> watched;
  for (auto _ : state) {
    plain.push_back(plain_s(fixture, out));
    watched.push_back(watched_s(*session, frames));
  }
  state.counters["panel_over_plain"] = median(watched) / median(plain);
  state.counters["plain_ms"] = 1e3 * median(plain);
  fs::remove_all(out);
}
BENCHMARK(panel_over_plain)->Iterations(25)->Unit(benchmark::kMillisecond);

}  // namespace
