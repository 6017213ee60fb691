// What a diagnosis costs: four runs at 1 kHz of a rigid axis with one effect hidden in it, from the
// logs in memory to the verdict, and where the time goes.
//
// `seconds_of_log` 15, 30, 60 a run: cost should grow as the data do, `us_per_sample` stay.
// `over_making`: beside the time that it takes to simulate the four logs, in the same process.
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "study/diagnose/diagnosis.h"
#include "tests/study/diagnose/hidden_case.h"

namespace {

using namespace towbench::study::diagnose;
using towbench::tests::HiddenAxis;
using Clock = std::chrono::steady_clock;

constexpr int kRuns = 4;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The same machine four times, each in its own motion.
Request four_runs(double seconds_of_log) {
  HiddenAxis axis;
  axis.effect = "quadratic_drag";
  axis.machine = 1;
  axis.duration_s = seconds_of_log;
  Request request;
  request.model = towbench::tests::nominal_of(axis);
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    request.runs.push_back(towbench::tests::run_of(axis, make_hidden_log(axis, seed)));
  }
  return request;
}

void diagnose_four_runs(benchmark::State& state) {
  const auto making = Clock::now();
  Request request = four_runs(static_cast<double>(state.range(0)));
  const double making_s = since(making);
  std::map<std::string, double> parts_s;
  std::string part;
  Clock::time_point begun;
  const auto turn_to = [&](const std::string& next) {
    if (!part.empty()) {
      parts_s[part] += since(begun);
    }
    part = next;
    begun = Clock::now();
  };
  request.progress = [&](const std::string& line) {
    // What is accepted on the way is told too; it is a part of looking for causes.
    if (!line.starts_with("accepted") && !line.starts_with("said")) {
      turn_to(line);
    }
  };
  double diagnosis_s = 0;
  std::size_t causes = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const Diagnosis d = diagnose(request);
    turn_to("");
    const double wall_s = since(start);
    state.SetIterationTime(wall_s);
    diagnosis_s += wall_s;
    causes = d.causes.size();
  }
  double samples = 0;
  for (const Run& run : request.runs) {
    samples += static_cast<double>(run.size());
  }
  const auto rounds = static_cast<double>(state.iterations());
  state.counters["us_per_sample"] = 1e6 * diagnosis_s / rounds / samples;
  state.counters["over_making"] = diagnosis_s / rounds / making_s;
  state.counters["causes"] = static_cast<double>(causes);
  for (const auto& [name, spent_s] : parts_s) {
    state.counters["% " + name] = 100 * spent_s / diagnosis_s;
  }
}
BENCHMARK(diagnose_four_runs)
    ->ArgName("seconds_of_log")
    ->Arg(15)
    ->Arg(30)
    ->Arg(60)
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseManualTime();

}  // namespace
