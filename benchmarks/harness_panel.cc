// What it costs a run at full speed that a panel looks on and may steer: the loop's own time with
// the panel's tap, hand and frames (made twenty times a second on another thread, as for an open
// page) over the loop's time without, in alternation.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
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

// On a thread of its own, as the panel's runs are: a thread's first memory costs it some
// milliseconds.
double plain_s(const ExperimentFixture& fixture, const fs::path& out) {
  RunOptions options;
  options.out = out;
  double took_s = 0;
  std::thread([&] { took_s = run_experiment(fixture, options).outcome.wall_time_s; }).join();
  return took_s;
}

double watched_s(Session& session, FrameMaker& frames, const char* experiment) {
  session.start({.experiment = experiment, .pace = {.speed = 0, .paused = false}});
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

void panel_over_plain(benchmark::State& state, const char* experiment) {
  const auto out = temporary_folder();
  const auto fixture = load_experiment(std::string("fixtures/experiments/") + experiment + ".toml");
  const auto session = std::make_unique<Session>(out);
  FrameMaker frames(*session);
  std::vector<double> plain;
  std::vector<double> watched;
  for (auto _ : state) {
    plain.push_back(plain_s(fixture, out));
    watched.push_back(watched_s(*session, frames, experiment));
  }
  state.counters["panel_over_plain"] = median(watched) / median(plain);
  // The quickest of each: what is left when the host's other work is left out.
  state.counters["quickest_over_quickest"] = *std::min_element(watched.begin(), watched.end()) /
                                             *std::min_element(plain.begin(), plain.end());
  state.counters["plain_ms"] = 1e3 * median(plain);
  fs::remove_all(out);
}
BENCHMARK_CAPTURE(panel_over_plain, circle, "circle")
    ->Iterations(25)
    ->Unit(benchmark::kMillisecond);
// Most edges to listen to: 0.4 m/s.
BENCHMARK_CAPTURE(panel_over_plain, trapezoid, "trapezoid-400")
    ->Iterations(25)
    ->Unit(benchmark::kMillisecond);

}  // namespace
