// The search beside the truth: for pairs of motion and fault every onset and size on a grid is run,
// so that the worst case is known; then the searches look for it, over many seeds, in that table.
//
// From the root of the repository:
//   falsify_truth sweep STEP_MS FOLDER [PAIR...]
//       runs the pairs, numbered from 1 (all), each into a file of margins; several processes may
//       run side by side, and what was interrupted goes on
//   falsify_truth page STEP_MS FOLDER PAGE.md
//       searches in those files and writes the table
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/campaign/campaign.h"
#include "harness/falsify/box_search.h"
#include "harness/falsify/objective.h"
#include "harness/falsify/onset_phases.h"
#include "harness/fault_cases/motion_phases.h"
#include "harness/fault_plan/fault_syntax.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/record/line_writer.h"
#include "harness/requirements/run_signals.h"

namespace {

using namespace towbench;
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
     "always: |x_error| < 2 mm"},
    // Behind the choice of the search's constants: they were chosen on the others.
    {"motions/trapezoid-y", "amplifier.y gain_drop ratio=0.3 duration_s={}", 0.02, 0.18,
     "always: |y_error| < 5 mm"},
    {"motions/end-y-max", "link.to_plant delay delay_s={} duration_s=0.1", 0.01, 0.09,
     "always: y_end_distance > 50 mm"}};
constexpr std::size_t kSizes = 3;
constexpr std::size_t kSeeds = 1000;
constexpr std::size_t kSnapshots = 64;  // of the fault-free run: two thirds of the time
constexpr double kShare = 0.02;         // of the runs of a sweep in steps of kFine_s
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
  std::optional<std::size_t> worst{};

  void add(std::optional<double> margin) {
    margins.push_back(margin);
    fired += margin ? 1U : 0U;
    if (margin && (!worst || *margin < *margins[*worst])) {
      worst = margins.size() - 1;
    }
    onsets = margins.size() / kSizes;
  }
};

std::string file_of(const std::string& folder, const Pair& pair) {
  return fmt::format("{}/pair-{}.csv", folder, &pair - std::begin(kPairs) + 1);
}

std::unique_ptr<Objective> objective_of(const Pair& pair) {
  const auto fixture = load_experiment("fixtures/" + std::string(pair.motion) + ".toml");
  Requirement requirement{.id = "R", .text = pair.formula};
  std::vector<std::string> windows;
  requirement.parsed = *parse_formula(pair.formula, run_vocabulary(windows));
  return in_process_objective(fixture, {requirement}, kSnapshots);
}

std::size_t runs_of(const Objective& objective, double step_s) {
  return kSizes * static_cast<std::size_t>(objective.end_s() / step_s);
}

std::vector<std::string> lines_of(const std::string& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

// Each line: onset, size, margin; no margin where the fault took no effect. Goes on behind the
// lines that are there.
void sweep(const Pair& pair, double step_s, const std::string& folder) {
  const auto objective = objective_of(pair);
  const auto file = file_of(folder, pair);
  auto i = lines_of(file).size();
  std::ofstream lines(file, std::ios::app);
  for (; i < runs_of(*objective, step_s); ++i) {
    const double onset_s = static_cast<double>(i / kSizes) * step_s;
    const double size = size_of(pair, i % kSizes);
    const auto words =
        fmt::format("{} at_s={:.6f}", fmt::format(fmt::runtime(pair.fault), size), onset_s);
    const auto outcome = objective->measure({.faults = {parse_fault(words)}});
    const auto margin =
        outcome.fired && outcome.margin ? fmt::format("{}", *outcome.margin) : std::string();
    lines << fmt::format("{:.6f},{},{}\n", onset_s, size, margin) << std::flush;
  }
}

Truth read_truth(const Pair& pair, double step_s, const std::string& folder) {
  const auto file = file_of(folder, pair);
  Truth truth;
  for (const auto& line : lines_of(file)) {
    const auto margin = line.substr(line.rfind(',') + 1);
    truth.add(margin.empty() ? std::nullopt : std::optional(std::stod(margin)));
  }
  if (!truth.worst || truth.margins.size() != runs_of(*objective_of(pair), step_s)) {
    throw std::runtime_error(file + " is not complete: sweep it first");
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
  const double worst = *truth.margins[*truth.worst];
  const auto apart =
      std::fabs(static_cast<double>(at / kSizes) - static_cast<double>(*truth.worst / kSizes));
  const bool near = at % kSizes == *truth.worst % kSizes && apart * step_s <= kNear_s;
  return near || std::fabs(*truth.margins[at] - worst) <= kNearMargin * std::fabs(worst);
}

std::size_t seeds_that_find(const Truth& truth, const std::vector<BoxSide>& sides,
                            Optimiser optimiser, std::size_t runs, double step_s) {
  const auto part = [](double share, std::size_t parts) {
    return std::min(parts - 1, static_cast<std::size_t>(share * static_cast<double>(parts)));
  };
  const auto index_of = [&](const BoxPoint& point) {
    return kSizes * part(point[0], truth.onsets) + part(point[1], kSizes);
  };
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto result =
        search_box({.sides = sides, .runs = runs, .seed = seed, .optimiser = optimiser},
                   [&](const BoxTrial& trial) { return truth.margins[index_of(trial.point)]; });
    const bool is_near =
        result.best && is_found(truth, index_of(result.trials[*result.best].point), step_s);
    found += is_near ? 1U : 0U;
  }
  return found;
}

// How a campaign lists: a drawn moment in each phase of the motion, here at each size.
struct PhaseList {
  std::vector<std::vector<PhaseSpan>> phases{};

  explicit PhaseList(const std::vector<PhaseSpan>& spans) {
    for (const auto phase : kPhaseNames) {
      std::vector<PhaseSpan> fitting;
      std::copy_if(spans.begin(), spans.end(), std::back_inserter(fitting),
                   [&](const PhaseSpan& span) { return span.phase == phase; });
      if (!fitting.empty()) {
        phases.push_back(std::move(fitting));
      }
    }
  }

  [[nodiscard]] std::size_t runs() const noexcept { return kSizes * phases.size(); }

  [[nodiscard]] std::size_t seeds_that_find(const Truth& truth, double step_s) const {
    std::size_t found = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      core::Random random(seed);
      bool hit = false;
      for (const auto& spans : phases) {
        const auto onset =
            std::min(truth.onsets - 1, static_cast<std::size_t>(moment_in(spans, random) / step_s));
        for (std::size_t size = 0; size < kSizes; ++size) {
          const auto at = onset * kSizes + size;
          hit = hit || (truth.margins[at] && is_found(truth, at, step_s));
        }
      }
      found += hit ? 1U : 0U;
    }
    return found;
  }
};

constexpr Optimiser kAll[] = {Optimiser::kUniform, Optimiser::kSubplex, Optimiser::kCrs,
                              Optimiser::kDirect, Optimiser::kEsch};

std::string page_head(double step_s) {
  std::string text = fmt::format(
      "# The search beside the truth\n\nWritten by `falsify_truth` "
      "(`tests/harness/falsify_truth`). For each pair every onset in steps of {:.0f} ms is run "
      "with "
      "{} sizes, so that the worst case is known. The searches have as many runs as {:.0f} % of a "
      "sweep in steps of 1 ms, over {} seeds, in that table. Found: within {:.0f} ms of the worst "
      "onset at its size, or a margin within {:.0f} % of its. List: a drawn moment in each phase "
      "of "
      "the motion, as a campaign takes it, at each size.\n\n| motion | fault | sizes | asked "
      "| "
      "onsets and sizes | took effect | worst onset | size | its margin | list: runs | found | "
      "search: runs |",
      step_s * 1e3, kSizes, 100 * kShare, kSeeds, kNear_s * 1e3, 100 * kNearMargin);
  std::string rule =
      "\n| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |";
  for (const auto optimiser : kAll) {
    text += fmt::format(" {} |", kOptimiserNames[static_cast<std::size_t>(optimiser)]);
    rule += " ---: |";
  }
  return text + rule + '\n';
}

std::string row_of(const Pair& pair, const Truth& truth, double step_s) {
  const auto runs = static_cast<std::size_t>(
      std::ceil(kShare * static_cast<double>(truth.margins.size()) * step_s / kFine_s));
  auto motion = load_motion("fixtures/" + std::string(pair.motion) + ".toml", {});
  run_reference(motion, {});
  const auto fault = parse_fault(fmt::format(fmt::runtime(pair.fault), pair.smallest) + " at_s=0");
  const PhaseList list(phases_of(motion.record(), trigger_axis(fault, motion.record())));
  const std::vector<BoxSide> sides{
      {.has_ends = false, .stretches = onset_phases({fault.place, fault.kind}, motion.record())},
      {}};
  auto row = fmt::format(
      "| {} | `{}` | {} to {} | `{}` | {} | {} | {:.3f} s | {} | {:.4g} | {} | {} | {} |",
      pair.motion, fmt::format(fmt::runtime(pair.fault), "N"), pair.smallest, pair.largest,
      masked(pair.formula), truth.margins.size(), truth.fired,
      static_cast<double>(*truth.worst / kSizes) * step_s, size_of(pair, *truth.worst % kSizes),
      *truth.margins[*truth.worst], list.runs(), list.seeds_that_find(truth, step_s), runs);
  for (const auto optimiser : kAll) {
    row += fmt::format(" {} |", seeds_that_find(truth, sides, optimiser, runs, step_s));
  }
  return row + '\n';
}

int execute(const std::vector<std::string>& words) {
  const double step_s = words.size() >= 3 ? std::atof(words[1].c_str()) * 1e-3 : 0;
  if (step_s > 0 && words[0] == "sweep") {
    std::set<std::string> chosen(words.begin() + 3, words.end());
    std::size_t number = 0;
    for (const auto& pair : kPairs) {
      if (chosen.empty() || chosen.count(std::to_string(++number)) > 0) {
        sweep(pair, step_s, words[2]);
      }
    }
    return 0;
  }
  if (step_s > 0 && words[0] == "page" && words.size() == 4) {
    auto page = page_head(step_s);
    for (const auto& pair : kPairs) {
      const auto row = row_of(pair, read_truth(pair, step_s, words[2]), step_s);
      std::fputs(row.c_str(), stdout);
      page += row;
    }
    write_atomically(words[3], page);
    return 0;
  }
  std::fputs(
      "usage: falsify_truth sweep STEP_MS FOLDER [PAIR...]\n"
      "       falsify_truth page STEP_MS FOLDER PAGE.md\n",
      stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  return execute({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::fprintf(stderr, "falsify_truth: %s\n", error.what());
  return 4;
}
