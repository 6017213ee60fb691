// towbench falsify: the faults with which a requirement comes nearest to breaking.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/command.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/experiment/experiment_toml.h"
#include "harness/falsify/falsify_report.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "harness/report/report.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

struct FalsifyOptions {
  std::string experiment;
  std::string requirement;
  std::vector<std::string> faults;
  std::string second;
  std::string budget = "2000 runs";
  std::string optimiser = "sbplx";
  std::string controller;
  std::string out;
  std::string keep;
  std::uint64_t seed = 1;
  std::size_t snapshots = 0;
  bool until_broken = false;
  bool fresh = false;
  bool quiet = false;
};

struct SearchBudget {
  std::size_t runs = 0;
  double time_s = 0;  // 0: as long as the runs take
};

SearchBudget parse_budget(const std::string& text) {
  static const std::regex kBudget(R"(\s*(\d{1,9}(?:\.\d{1,3})?)\s*(runs|min|s|h)?\s*)");
  std::smatch found;
  if (std::regex_match(text, found, kBudget)) {
    const double number = std::stod(found[1]);
    const auto unit = found[2].str();
    if (number > 0 && (unit.empty() || unit == "runs") && number == std::floor(number)) {
      return {static_cast<std::size_t>(number), 0};
    }
    if (number > 0 && !unit.empty() && unit != "runs") {
      constexpr std::size_t kAnyNumber = 1'000'000'000;
      return {kAnyNumber, number * (unit == "h" ? 3600 : unit == "min" ? 60 : 1)};
    }
  }
  throw FixtureError({.file = "command line", .key = "--budget"}, '"' + text + '"',
                     "a number above 0 with runs, s, min or h: \"2000 runs\", \"10 min\"");
}

Optimiser optimiser_named(const std::string& text) {
  const auto* const name = std::find(std::begin(kOptimiserNames), std::end(kOptimiserNames), text);
  if (name == std::end(kOptimiserNames)) {
    throw FixtureError({.file = "command line", .key = "--optimiser"}, '"' + text + '"',
                       fmt::format("{}", fmt::join(kOptimiserNames, ", ")));
  }
  return static_cast<Optimiser>(name - std::begin(kOptimiserNames));
}

Asked asked_of(const FalsifyOptions& options, const Experiment& experiment) {
  if (options.requirement == "rules") {
    return {};
  }
  std::vector<const Requirement*> fitting;
  std::string ids = "rules";
  for (const auto& requirement : experiment.requirements) {
    ids += ' ' + requirement.id;
    if (options.requirement.empty() ? requirement.under_faults
                                    : requirement.id == options.requirement) {
      fitting.push_back(&requirement);
    }
  }
  if (fitting.size() == 1) {
    return {.requirement = *fitting.front()};
  }
  if (fitting.empty() && options.requirement.empty()) {
    return {};
  }
  throw FixtureError({.file = "command line", .key = "--requirement"},
                     options.requirement.empty() ? "none, and several of the experiment apply"
                                                 : '"' + options.requirement + '"',
                     "one of: " + ids);
}

CandidateController candidate_of(const std::string& text) {
  RunOptions options;
  choose_controller(text, options);
  if (options.external && options.external->address) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + text + '"',
                       "process:COMMAND or firmware:IMAGE.elf: it is started again for every run");
  }
  return {.external = options.external, .firmware = options.firmware, .text = text};
}

std::vector<FaultSpace> spaces_of(const FalsifyOptions& options, const ExperimentFixture& fixture,
                                  double end_s) {
  core::PerAxis<bool> exists;
  for (const auto axis : core::kAxes) {
    exists[axis] = fixture.rig.parameters.axes[axis].exists;
  }
  std::vector<FaultChoice> second;
  if (!options.second.empty()) {
    second = fault_choices({options.second}, exists);
  }
  std::vector<FaultSpace> spaces;
  for (const auto& choice : fault_choices(options.faults, exists)) {
    if (second.empty()) {
      spaces.emplace_back(std::vector{choice}, end_s);
    }
    for (const auto& other : second) {
      spaces.emplace_back(std::vector{choice, other}, end_s);
    }
  }
  return spaces;
}

std::string fingerprint_of(const FalsifyOptions& options, const ExperimentFixture& fixture,
                           const Asked& asked, const CandidateController& controller,
                           const std::vector<FaultSpace>& spaces, std::size_t runs_a_round) {
  CanonicalHash hash;
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << program.rdbuf();
  hash.add(bytes.str());
  for (const auto& source : fixture.sources) {
    hash.add(source.text);
  }
  hash.add(asked.name() + '\n' + asked.text() + '\n' + options.optimiser + '\n' +
           fmt::format("{} {} {}", options.seed, runs_a_round, options.until_broken));
  for (const auto& space : spaces) {
    hash.add(space.name());
  }
  add_identity(controller, hash);
  return hash_text(hash.value());
}

std::string how_far(const FalsifySession& session, const SearchBudget& budget, double elapsed_s,
                    const std::string& unit) {
  const auto* worst = session.worst();
  const auto best = worst == nullptr
                        ? std::string("no fault took effect yet")
                        : fmt::format("smallest margin {:.4g} {} ({})", *worst->outcome.margin,
                                      unit, session.spaces()[worst->space].name());
  const auto of = budget.time_s > 0 ? fmt::format(", {:.0f} of {:.0f} s", elapsed_s, budget.time_s)
                                    : fmt::format(" of {} runs", budget.runs);
  return fmt::format("{}{}, {}", session.trials().size(), of, best);
}

// The experiment with its worst faults and what was asked, as `towbench run` takes it.
ExperimentFixture worst_experiment(const ExperimentFixture& fixture, const Asked& asked,
                                   const FalsifyTrial& worst) {
  auto made = fixture;
  auto& experiment = made.experiment;
  experiment.requirements.clear();
  if (asked.requirement) {
    experiment.requirements.push_back(*asked.requirement);
    experiment.requirements.front().under_faults = true;
  }
  experiment.budgets.clear();
  constexpr std::size_t kLongestName = 53;
  experiment.name = experiment.name.substr(0, kLongestName) + "-worst";
  experiment.title = "Worst case found of " + asked.name();
  experiment.description =
      fmt::format("Found by towbench falsify in {}: margin {:.6g} {}.", fixture.experiment.name,
                  *worst.outcome.margin, asked.unit());
  made.sources.front().text = to_toml(made);
  FaultPlan plan;
  for (const auto& words : worst.faults) {
    plan.push_back(parse_fault(words));
  }
  add_faults(made, plan);
  return made;
}

void keep_experiment(const std::filesystem::path& file, const ExperimentFixture& made) {
  const auto near = [&](const std::filesystem::path& path) {
    return path.empty() ? std::string()
                        : std::filesystem::proximate(std::filesystem::absolute(path),
                                                     std::filesystem::absolute(file).parent_path())
                              .generic_string();
  };
  write_atomically(file, to_toml(made, near(made.rig_file), near(made.controller_file)));
}

int report_worst(const FalsifyOptions& options, const ExperimentFixture& fixture,
                 const Asked& asked, const CandidateController& controller,
                 const FalsifyTrial& worst) {
  const auto made = worst_experiment(fixture, asked, worst);
  RunOptions run_options;
  run_options.out = options.out;
  choose_candidate(controller, run_options);
  const auto run = run_experiment(made, run_options);
  if (const auto page = write_report(run.folder); !page) {
    std::fprintf(stderr, "towbench: %s\n", page.error().c_str());
  }
  if (!options.keep.empty()) {
    keep_experiment(options.keep, made);
    std::printf("kept as %s\n", options.keep.c_str());
  }
  std::printf("%s\n", (run.folder / "report.html").c_str());
  return worst.outcome.broken ? kExitFail : kExitPass;
}

int execute_falsify(FalsifyOptions& options) {
  const auto budget = parse_budget(options.budget);
  const auto fixture = load_experiment(find_experiment(options.experiment));
  const auto asked = asked_of(options, fixture.experiment);
  const auto controller = candidate_of(options.controller);
  if (!fixture.experiment.faults.empty()) {
    throw FixtureError({.file = fixture.file.string()}, "an experiment with faults",
                       "one without: the search brings its own");
  }
  if (options.out.empty()) {
    options.out = "runs/falsify-" + fixture.experiment.name;
  }
  const auto objective = controller.is_bbmc()
                             ? in_process_objective(fixture, asked, options.snapshots)
                             : candidate_objective(fixture, asked, controller);
  const auto spaces = spaces_of(options, fixture, objective->end_s());
  const auto runs_a_round = std::clamp<std::size_t>(budget.runs / spaces.size(),
                                                    std::min<std::size_t>(20, budget.runs), 200);
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  if (options.fresh) {
    std::filesystem::remove(folder / "trials.jsonl");
  }
  FalsifySettings settings{.runs = budget.runs,
                           .runs_a_round = runs_a_round,
                           .seed = options.seed,
                           .optimiser = optimiser_named(options.optimiser),
                           .until_broken = options.until_broken};
  settings.fingerprint = fingerprint_of(options, fixture, asked, controller, spaces, runs_a_round);
  FalsifySession session(settings, spaces, folder / "trials.jsonl");
  bool whole = false;
  {
    ProgressLine progress(!options.quiet);
    const auto time_is_left = [&] {
      return budget.time_s == 0 || progress.elapsed_s() < budget.time_s;
    };
    whole = session.run(
        *objective, [&] { return !stop_requested() && time_is_left(); },
        [&](const FalsifySession& now) {
          progress.show_sometimes(
              [&] { return how_far(now, budget, progress.elapsed_s(), asked.unit()); });
        });
  }
  const auto text = falsify_report(session, asked, fixture.experiment.name);
  write_atomically(folder / "falsify.md", text);
  if (!options.quiet) {
    std::fputs(text.c_str(), stdout);
  }
  if (!whole && stop_requested()) {
    std::printf("interrupted after %zu runs; the same command goes on\n", session.trials().size());
    return kExitRuntime;
  }
  const auto* worst = session.worst();
  if (worst == nullptr) {
    std::printf("INVALID  %s: no fault took effect, so nothing was tried\n",
                fixture.experiment.name.c_str());
    return kExitInvalid;
  }
  return report_worst(options, fixture, asked, controller, *worst);
}

}  // namespace

void add_falsify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<FalsifyOptions>();
  auto* verb = app.add_subcommand("falsify", "search the faults that break a requirement");
  verb->add_option("experiment", options->experiment,
                   "name of an experiment of fixtures/experiments, or a path")
      ->required();
  verb->add_option("--requirement", options->requirement,
                   "id of a [[requirement]], or rules: what holds whatever fails [the one with "
                   "under_faults, else rules]");
  verb->add_option("--faults", options->faults,
                   "kinds, places or \"PLACE KIND\", separated by commas [all]")
      ->delimiter(',');
  verb->add_option("--second", options->second, "a second fault in every run: \"PLACE KIND\"");
  verb->add_option("--budget", options->budget, "\"2000 runs\", or a time: \"10 min\"")
      ->capture_default_str();
  verb->add_option("--optimiser", options->optimiser,
                   "what chooses behind the uniform samples: sbplx, crs2, direct, esch; uniform: "
                   "nothing does")
      ->capture_default_str();
  verb->add_option("--controller", options->controller,
                   "instead of BBMC: process:\"COMMAND {address}\" or firmware:IMAGE.elf");
  verb->add_option("--seed", options->seed, "of the search")->check(whole_number());
  verb->add_option("--snapshots", options->snapshots,
                   "moments from which runs in this process go on; 0: each begins anew")
      ->check(CLI::Range(0, 200))
      ->capture_default_str();
  verb->add_option("--out", options->out,
                   "folder of trials, falsify.md and the worst run; trials that are there are not "
                   "run again [runs/falsify-EXPERIMENT]")
      ->check(folder_to_write());
  verb->add_option("--keep", options->keep, "write the worst case as an experiment to this file");
  verb->add_flag("--until-broken", options->until_broken, "stop at the first that breaks it");
  verb->add_flag("--fresh", options->fresh, "forget the trials that are there");
  verb->add_flag("-q,--quiet", options->quiet, "print the report's path only");
  verb->footer(
      "Example: towbench falsify kill-1khz --faults \"encoder.y frozen\" --budget \"200 runs\"\n"
      "Guide: docs/guide/worst-case.md");
  verb->callback([options, &exit_code] { exit_code = execute_falsify(*options); });
}

}  // namespace towbench::harness
