// The search beside the truth: for pairs of motion and fault every onset and size on a grid is run,
// so that the worst case is known; then the searches look for it, over many seeds, in that table.
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
  const char* fault;  // without its onset; {}: its size
  double smallest;
  double largest;
  const char* formula;
};
constexpr Pair kPairs[] = {
    {"experiments/trapezoid-400", "drive.y brake_drag force_N={} duration_s=0.1", 20, 100,
     "always: |y_error| < 5 mm"},
    {"experiments/trapezoid-400", "supply sag lost_V={} duration_s=0.3", 2, 10,
     "always: |y_error| < 5 mm"},
    {"experiments/trapezoid-400", "amplifier.y stuck_duty duration_s={}", 0.01, 0.09,
     "always: |y_carriage_speed| < 0.6 m/s"},
    {"experiments/endstop-y-max", "endstop.y_max stuck_open duration_s={}", 0.1, 0.9,
     "always: y_end_distance > 50 mm"},
    {"motions/circle-short", "encoder.y jump counts={}", 40, 360, "always: |y_error| < 1 mm"},
    {"motions/trapezoid-x", "link.to_controller delay delay_s={} duration_s=0.1", 0.001, 0.005,
     "always: |x_error| < 2 mm"}};
constexpr std::size_t kSizes = 3;
constexpr std::size_t kSeeds = 100;
constexpr double kShare = 0.02;  // of the runs of a sweep in steps of kFine_s
constexpr double kFine_s = 1e-3;
constexpr double kNear_s = 2e-3;
constexpr double kNearMargin = 0.02;

double size_of(const Pair& pair, std::size_t level) {
  return pair.smallest + (pair.largest - pair.smallest) * static_cast<double>(level) / (kSizes - 1);
}

// One margin for each onset and size.
struct Truth {
  std::size_t onsets = 0;
  std::vector<std::optional<double>> margins{};  // sizes of an onset side by side
  std::size_t fired = 0;
  std::size_t worst = 0;
};

Truth exhaust(const Pair& pair, double step_s) {
  const auto fixture = load_experiment("fixtures/" + std::string(pair.motion) + ".toml");
  Requirement requirement{.id = "R", .text = pair.formula};
  std::vector<std::string> windows;
  requirement.parsed = *parse_formula(pair.formula, run_vocabulary(windows));
  const auto objective = in_process_objective(fixture, {requirement}, 0);
  Truth truth{.onsets = static_cast<std::size_t>(objective->end_s() / step_s)};
  for (std::size_t i = 0; i < truth.onsets * kSizes; ++i) {
    const auto words = fmt::format("{} at_s={:.6f}",
                                   fmt::format(fmt::runtime(pair.fault), size_of(pair, i % kSizes)),
                                   static_cast<double>(i / kSizes) * step_s);
    const auto outcome = objective->measure({.faults = {parse_fault(words)}});
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

// Within kNear_s of the worst onset at its size, or within kNearMargin of its margin.
bool is_found(const Truth& truth, std::size_t at, double step_s) {
  const double worst = *truth.margins[truth.worst];
  const auto apart =
      std::fabs(static_cast<double>(at / kSizes) - static_cast<double>(truth.worst / kSizes));
  const bool near = at % kSizes == truth.worst % kSizes && apart * step_s <= kNear_s;
  return near || std::fabs(*truth.margins[at] - worst) <= kNearMargin * std::fabs(worst);
}

std::size_t seeds_that_find(const Truth& truth, Optimiser optimiser, std::size_t runs,
                            double step_s) {
  const auto part = [](double share, std::size_t parts) {
    return std::min(parts - 1, static_cast<std::size_t>(share * static_cast<double>(parts)));
  };
  const auto index_of = [&](const BoxPoint& point) {
    return kSizes * part(point[0], truth.onsets) + part(point[1], kSizes);
  };
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto result =
        search_box({.variables = 2, .runs = runs, .seed = seed, .optimiser = optimiser},
                   [&](const BoxTrial& trial) { return truth.margins[index_of(trial.point)]; });
    const bool is_near =
        result.best && is_found(truth, index_of(result.trials[*result.best].point), step_s);
    found += is_near ? 1U : 0U;
  }
  return found;
}

constexpr Optimiser kAll[] = {Optimiser::kUniform, Optimiser::kSubplex, Optimiser::kCrs,
                              Optimiser::kDirect, Optimiser::kEsch};

std::string page_head(double step_s) {
  std::string text = fmt::format(
      "# The search beside the truth\n\nWritten by `falsify_truth` "
      "(`tests/harness/falsify_truth`). For each pair every onset in steps of {:.0f} ms is run "
      "with "
      "{} sizes, so that the worst case is known. The searches have as many runs as {:.0f} % of a "
      "sweep in steps of 1 ms, over {} seeds, in that table. Found: within {:.0f} ms of the worst "
      "onset at its size, or a margin within {:.0f} % of its.\n\n| motion | fault | sizes | asked "
      "| "
      "onsets and sizes | took effect | worst onset | size | its margin | runs |",
      step_s * 1e3, kSizes, 100 * kShare, kSeeds, kNear_s * 1e3, 100 * kNearMargin);
  std::string rule = "\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |";
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
    const auto runs = static_cast<std::size_t>(
        std::ceil(kShare * static_cast<double>(truth.margins.size()) * step_s / kFine_s));
    auto row =
        fmt::format("| {} | `{}` | {} to {} | `{}` | {} | {} | {:.3f} s | {} | {:.4g} | {} |",
                    pair.motion, fmt::format(fmt::runtime(pair.fault), "N"), pair.smallest,
                    pair.largest, masked(pair.formula), truth.margins.size(), truth.fired,
                    static_cast<double>(truth.worst / kSizes) * step_s,
                    size_of(pair, truth.worst % kSizes), *truth.margins[truth.worst], runs);
    for (const auto optimiser : kAll) {
      row += fmt::format(" {} |", seeds_that_find(truth, optimiser, runs, step_s));
    }
    std::printf("%s\n", row.c_str());
    std::fflush(stdout);
    page += row + '\n';
    std::ofstream(argv[2]) << page;  // what is done is kept
  }
  return 0;
}
