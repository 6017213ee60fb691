// The search beside the truth: for pairs of motion and fault every onset on a grid is run, so that
// the worst one is known; then the searches look for it, over many seeds, in that table.
//
// usage: falsify_truth STEP_MS PAGE.md        writes the page; run from the root of the repository
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/falsify/box_search.h"
#include "harness/falsify/objective.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/requirements/run_signals.h"

namespace {

using namespace towbench::harness;

struct Pair {
  const char* motion;
  const char* fault;  // without its onset
  const char* formula;
};
constexpr Pair kPairs[] = {
    {"trapezoid-400", "drive.y brake_drag force_N=60 duration_s=0.1", "always: |y_error| < 5 mm"},
    {"trapezoid-400", "supply sag lost_V=9 duration_s=0.3", "always: |y_error| < 5 mm"},
    {"trapezoid-400", "amplifier.y stuck_duty duration_s=0.05",
     "always: |y_carriage_speed| < 0.6 m/s"},
    {"endstop-y-max", "endstop.y_max stuck_open duration_s=0.4", "always: y_end_distance > 50 mm"}};
constexpr std::size_t kSeeds = 100;
constexpr double kShare = 0.02;  // of the runs of a sweep in steps of kFine_s
constexpr double kFine_s = 1e-3;

struct Truth {
  std::vector<std::optional<double>> margins;  // one an onset
  std::size_t fired = 0;
  std::size_t worst = 0;
};

Truth exhaust(const Pair& pair, double step_s) {
  const auto fixture =
      load_experiment("fixtures/experiments/" + std::string(pair.motion) + ".toml");
  Requirement requirement{.id = "R", .text = pair.formula};
  std::vector<std::string> windows;
  requirement.parsed = *parse_formula(pair.formula, run_vocabulary(windows));
  const auto objective = in_process_objective(fixture, {requirement}, 64);
  Truth truth;
  const auto onsets = static_cast<std::size_t>(objective->end_s() / step_s);
  for (std::size_t i = 0; i < onsets; ++i) {
    const auto words = fmt::format("{} at_s={}", pair.fault, static_cast<double>(i) * step_s);
    const auto outcome = objective->measure({{parse_fault(words)}});
    truth.margins.push_back(outcome.fired ? outcome.margin : std::nullopt);
    truth.fired += outcome.fired ? 1U : 0U;
    const auto& best = truth.margins[truth.worst];
    if (truth.margins.back() && (!best || *truth.margins.back() < *best)) {
      truth.worst = i;
    }
  }
  return truth;
}

// A bar inside a cell of a table.
std::string masked(const std::string& text) {
  std::string cell;
  for (const char letter : text) {
    cell += letter == '|' ? "\\|" : std::string(1, letter);
  }
  return cell;
}

// In the step of the worst onset, or within 2 % of its margin.
bool is_found(const Truth& truth, std::size_t at) {
  const double worst = *truth.margins[truth.worst];
  return at == truth.worst || std::fabs(*truth.margins[at] - worst) <= 0.02 * std::fabs(worst);
}

std::size_t seeds_that_find(const Truth& truth, Optimiser optimiser, std::size_t runs) {
  const auto onsets = truth.margins.size();
  const auto index_of = [&](const BoxPoint& point) {
    return std::min(onsets - 1, static_cast<std::size_t>(point[0] * static_cast<double>(onsets)));
  };
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto result =
        search_box({.variables = 1, .runs = runs, .seed = seed, .optimiser = optimiser},
                   [&](const BoxTrial& trial) { return truth.margins[index_of(trial.point)]; });
    found += result.best && is_found(truth, index_of(result.trials[*result.best].point)) ? 1U : 0U;
  }
  return found;
}

constexpr Optimiser kAll[] = {Optimiser::kUniform, Optimiser::kSubplex, Optimiser::kCrs,
                              Optimiser::kDirect, Optimiser::kEsch};

std::string page_head(double step_s) {
  std::string text = fmt::format(
      "# The search beside the truth\n\nWritten by `falsify_truth` "
      "(`tests/harness/falsify_truth`). "
      "For each pair every onset in steps of {:.0f} ms is run, so that the worst one is known. The "
      "searches have as many runs as {:.0f} % of a sweep in steps of 1 ms, over {} seeds, in that "
      "table. Found: the step of the worst onset, or a margin within 2 % of its. Sizes are fixed: "
      "a "
      "search over the onset alone.\n\n| motion | fault | asked | onsets | took effect | worst "
      "onset | its margin | runs |",
      step_s * 1e3, 100 * kShare, kSeeds);
  std::string rule = "\n| --- | --- | --- | --- | --- | --- | --- | --- |";
  for (const auto optimiser : kAll) {
    text += fmt::format(" {} |", kOptimiserNames[static_cast<std::size_t>(optimiser)]);
    rule += " --- |";
  }
  return text + rule + '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const double step_s = argc == 3 ? std::atof(argv[1]) * 1e-3 : 0;
  if (!(step_s > 0)) {
    std::fprintf(stderr, "usage: falsify_truth STEP_MS PAGE.md\n");
    return 2;
  }
  auto page = page_head(step_s);
  for (const auto& pair : kPairs) {
    const auto truth = exhaust(pair, step_s);
    if (!truth.margins[truth.worst]) {
      std::fprintf(stderr, "%s: %s took no effect\n", pair.motion, pair.fault);
      return 4;
    }
    auto row = fmt::format("| {} | `{}` | `{}` | {} | {} | {:.3f} s | {:.4g} |", pair.motion,
                           pair.fault, masked(pair.formula), truth.margins.size(), truth.fired,
                           static_cast<double>(truth.worst) * step_s, *truth.margins[truth.worst]);
    const auto runs = static_cast<std::size_t>(
        std::ceil(kShare * static_cast<double>(truth.margins.size()) * step_s / kFine_s));
    row += fmt::format(" {} |", runs);
    for (const auto optimiser : kAll) {
      row += fmt::format(" {} |", seeds_that_find(truth, optimiser, runs));
    }
    std::printf("%s\n", row.c_str());
    std::fflush(stdout);
    page += row + '\n';
    std::ofstream(argv[2]) << page;  // what is done is kept
  }
  return 0;
}
