// What a diagnosis costs: four runs at 1 kHz of a rigid axis with one effect hidden in it, from the
// logs in memory to the verdict, and where the time goes.
//
// `seconds_of_log` 15, 30, 60 a run: cost should grow as the data do, `us_per_sample` stay. Beside
// it the same data through a plain sparse regression (sequentially thresholded least squares;
// Brunton, Proctor, Kutz 2016) over one group of columns an effect: no simulated reference, no
// correction for correlated noise, no held-out gain. `over_sparse` is the ratio of the two, of one
// and the same process and data.
#include <Eigen/QR>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "study/diagnose/context.h"
#include "study/diagnose/diagnosis.h"
#include "study/diagnose/evidence.h"
#include "tests/study/diagnose/hidden_case.h"

namespace {

using namespace towbench::harness::diagnose;
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

// One term an effect, at the first point of its grid; what is sought in the residual has none.
std::vector<Term> one_term_an_effect(const Context& context) {
  std::vector<Term> terms;
  for (const Effect& effect : effect_library()) {
    const auto grid = effect.grid(context);
    if (!grid.empty()) {
      terms.push_back({&effect, grid.front()});
    }
  }
  return terms;
}

// Filtered columns of all terms, least squares, and again without the coefficients that contribute
// less than 2 % of the force, until none is left out.
Eigen::Index sparse_regression(const Request& request) {
  constexpr double kThreshold = 0.02;
  const Dataset data =
      make_dataset(request.runs, choose_conditioning(request.runs, request.model),
                   stated_baseline(request.model), [](auto, auto) { return true; });
  const Context context = make_context(request.model, data);
  const Eigen::MatrixXd all = design_matrix(data, context, one_term_an_effect(context));
  const Eigen::VectorXd force =
      data.stack([](const Signals& s) -> Eigen::MatrixXd { return s.input_N; });
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < all.cols(); ++j) {
    kept.push_back(j);
  }
  for (std::size_t before = 0; before != kept.size();) {
    before = kept.size();
    const Eigen::MatrixXd x = all(Eigen::all, kept);
    const Eigen::VectorXd beta = x.colPivHouseholderQr().solve(force);
    std::vector<Eigen::Index> strong;
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      if (std::abs(beta[j]) * x.col(j).norm() > kThreshold * force.norm()) {
        strong.push_back(kept[static_cast<std::size_t>(j)]);
      }
    }
    kept = strong;
  }
  return static_cast<Eigen::Index>(kept.size());
}

void diagnose_four_runs(benchmark::State& state) {
  Request request = four_runs(static_cast<double>(state.range(0)));
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
  double sparse_s = 0;
  std::size_t causes = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const Diagnosis d = diagnose(request);
    turn_to("");
    const double wall_s = since(start);
    state.SetIterationTime(wall_s);
    diagnosis_s += wall_s;
    causes = d.selection.causes.size();
    const auto sparse_start = Clock::now();
    benchmark::DoNotOptimize(sparse_regression(request));
    sparse_s += since(sparse_start);
  }
  double samples = 0;
  for (const Run& run : request.runs) {
    samples += static_cast<double>(run.size());
  }
  const auto rounds = static_cast<double>(state.iterations());
  state.counters["us_per_sample"] = 1e6 * diagnosis_s / rounds / samples;
  state.counters["sparse_s"] = sparse_s / rounds;
  state.counters["over_sparse"] = diagnosis_s / sparse_s;
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
