// What it costs a run at full speed that a panel observes and may steer: the loop's own time with
// the panel's tap, operator and frames (made twenty times a second on another thread, as for an
// open page) over the loop's time without, in alternation.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <time.h>

#include "harness/panel/frames.h"
#include "harness/panel/live_operator.h"
#include "harness/panel/turns.h"

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
  observe_only();
  session.start({.experiment = experiment, .pace = {.speed = 0, .paused = false}});
  while (session.state().phase != Session::Phase::kOver) {
    benchmark::DoNotOptimize(frames.next());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  share_processor();
  std::ifstream stream(session.runs() / session.state().folder / "result.json");
  return nlohmann::json::parse(stream).at("wall_time_s").get<double>();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// The median over pairs of neighbours, and its 95 % interval by order statistics (binomial, normal
// approximation): what else the host does hits both of a pair or spoils it alone.
void tell_ratio(benchmark::State& state, const std::string& name, const std::vector<double>& with,
                const std::vector<double>& without) {
  std::vector<double> ratios(with.size());
  std::transform(with.begin(), with.end(), without.begin(), ratios.begin(), std::divides<>());
  std::sort(ratios.begin(), ratios.end());
  const auto pairs = static_cast<double>(ratios.size());
  const double half = 0.98 * std::sqrt(pairs);
  const auto at = [&](double rank) {
    return ratios[static_cast<std::size_t>(std::clamp(rank, 0.0, pairs - 1))];
  };
  state.counters[name] = median(ratios);
  state.counters[name + "_low"] = at(pairs / 2 - half);
  state.counters[name + "_high"] = at(pairs / 2 + half);
  state.counters["plain_ms"] = 1e3 * median(without);
}

// Processor time of the bench's own thread between the first and the last time that a run tells how
// far it has come: what a host that is busy otherwise leaves true.
class ThreadTime {
 public:
  [[nodiscard]] LoopWatchers watchers() {
    LoopWatchers watchers;
    watchers.progress = [this](towbench::core::Nanoseconds /*now_ns*/) {
      timespec now{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
      last_s_ = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
      first_s_ = first_s_ < 0 ? last_s_ : first_s_;
    };
    return watchers;
  }
  [[nodiscard]] double passed_s() const { return last_s_ - first_s_; }

 private:
  double first_s_ = -1;
  double last_s_ = -1;
};

double thread_s(const ExperimentFixture& fixture, const fs::path& out, LiveTap* tap) {
  ThreadTime time;
  const std::atomic<bool> stop{false};
  LiveOperator run_operator(fixture, 1, {.speed = 0, .paused = false}, false, stop);
  RunOptions options;
  options.out = out;
  options.watchers = time.watchers();
  if (tap != nullptr) {
    const auto& controller = fixture.controller.configuration;
    tap->clear(towbench::bbmc::exchange_period_ns(controller.control_period_ns()),
               LiveTap::Histogram::kTook, fixture.rig.parameters.force_sensor.fitted);
    options.tap = tap;
    options.run_operator = &run_operator;
  }
  std::thread([&] { (void)run_experiment(fixture, options); }).join();
  return time.passed_s();
}

// Takes the last stretch once a second, as a panel's frames do at full speed, while it lives.
class Reader {
 public:
  explicit Reader(LiveTap& tap)
      : thread_([this, &tap] {
          std::vector<LiveRow> rows;
          std::vector<LiveTruth> truths;
          for (int question = 0; !ending_; ++question) {
            if (question % FrameMaker::kHeldBack == 0) {
              (void)tap.rows().copy(beginning(tap.rows()), rows);
              (void)tap.truths().copy(beginning(tap.truths()), truths);
              benchmark::ClobberMemory();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
          }
        }) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() {
    ending_ = true;
    thread_.join();
  }

 private:
  template <typename Row>
  static std::uint64_t beginning(const LastRows<Row>& rows) {
    const auto end = rows.written();
    return end > rows.least() ? end - rows.least() : 0;
  }

  std::atomic<bool> ending_{false};
  std::thread thread_;
};

void panel_thread_over_plain(benchmark::State& state, const char* experiment) {
  const auto out = temporary_folder();
  const auto fixture = load_experiment(experiment);
  const auto tap = std::make_unique<LiveTap>();
  std::vector<double> plain;
  std::vector<double> watched;
  for (auto _ : state) {
    plain.push_back(thread_s(fixture, out, nullptr));
    const Reader reader(*tap);
    watched.push_back(thread_s(fixture, out, tap.get()));
  }
  tell_ratio(state, "thread_over_plain", watched, plain);
  fs::remove_all(out);
}
BENCHMARK_CAPTURE(panel_thread_over_plain, circle, "fixtures/experiments/circle.toml")
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(panel_thread_over_plain, exercise, "fixtures/diagnosis/exercise-y.toml")
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);

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
  tell_ratio(state, "panel_over_plain", watched, plain);
  // The quickest of each: what is left when the host's other work is left out.
  state.counters["quickest_over_quickest"] = *std::min_element(watched.begin(), watched.end()) /
                                             *std::min_element(plain.begin(), plain.end());
  fs::remove_all(out);
}
BENCHMARK_CAPTURE(panel_over_plain, circle, "circle")
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);
// A minute of them: what starting and ending cost is nothing beside it.
BENCHMARK_CAPTURE(panel_over_plain, minute, "wall-clock-60s")
    ->Iterations(30)
    ->Unit(benchmark::kMillisecond);
// Most edges to listen to: 0.4 m/s.
BENCHMARK_CAPTURE(panel_over_plain, trapezoid, "trapezoid-400")
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

}  // namespace
