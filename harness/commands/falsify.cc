// towbench falsify: the faults with which a requirement comes nearest to breaking.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/command.h"
#include "harness/commands/falsify_options.h"
#include "harness/commands/falsify_parts.h"
#include "harness/commands/falsify_worst.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/stop_signal.h"
#include "harness/falsify/falsify_report.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

// On the axes of this rig; another experiment's may have more.
std::vector<FaultChoice> searched_faults(const FalsifyOptions& options,
                                         const core::PerAxis<bool>& exists) {
  constexpr core::PerAxis<bool> kAll{{true, true}};
  const bool alone = options.experiments.size() == 1;
  auto choices = fault_choices(options.faults, alone ? exists : kAll);
  const auto here = fault_choices({}, exists);
  const auto left_out =
      options.except.empty() ? std::vector<FaultChoice>{} : fault_choices(options.except, kAll);
  const auto holds = [](const std::vector<FaultChoice>& all, const FaultChoice& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  std::erase_if(choices,
                [&](const FaultChoice& one) { return holds(left_out, one) || !holds(here, one); });
  if (choices.empty() && alone) {
    throw FixtureError({.file = "command line", .key = "--except"},
                       fmt::format("{}", fmt::join(options.except, ",")),
                       "fewer than --faults names: no fault is left");
  }
  return choices;
}

std::vector<FaultSpace> fault_spaces(const FalsifyOptions& options,
                                     const ExperimentFixture& fixture, const Objective& objective) {
  const double end_s = objective.end_s();
  core::PerAxis<bool> exists;
  for (const auto axis : core::kAllAxes) {
    exists[axis] = fixture.rig.parameters.axes[axis].exists;
  }
  const SetupSpace setup(options.setup, exists, end_s);
  if (searches_no_fault(options)) {
    return {FaultSpace({}, end_s, setup)};
  }
  std::vector<FaultChoice> second;
  if (!options.second.empty()) {
    second = fault_choices({options.second}, exists);
  }
  std::vector<FaultSpace> spaces;
  for (const auto& choice : searched_faults(options, exists)) {
    std::vector<std::vector<Stretch>> phases{objective.phases_of(choice)};
    if (second.empty()) {
      spaces.emplace_back(std::vector{choice}, end_s, setup, phases);
    }
    for (const auto& other : second) {
      phases.resize(1);
      phases.push_back(objective.phases_of(other));
      spaces.emplace_back(std::vector{choice, other}, end_s, setup, phases);
    }
  }
  return spaces;
}

std::string fingerprint_of(const FalsifyOptions& options,
                           const std::vector<ExperimentFixture>& fixtures, const Asked& asked,
                           const CandidateController& controller, const Search& search) {
  CanonicalHash hash;
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << program.rdbuf();
  hash.add(bytes.str());
  for (const auto& fixture : fixtures) {
    for (const auto& source : fixture.sources) {
      hash.add(source.text);
    }
  }
  hash.add(asked.name() + '\n' + asked.text() + '\n' + options.optimiser + '\n' +
           fmt::format("{} {} {} {}", options.seed, search.settings.runs_a_round,
                       options.until_broken, options.setup.typed));
  for (const auto& space : search.spaces) {
    hash.add(space.name());
    for (const auto& variable : space.faults.variables()) {
      hash.add(fmt::format("{} {} {}", variable.name, variable.from, variable.to));
    }
  }
  add_identity(controller, hash);
  return hash_text(hash.value());
}

std::vector<ExperimentFixture> searched_experiments(const FalsifyOptions& options) {
  std::vector<ExperimentFixture> fixtures;
  for (const auto& name : options.experiments) {
    fixtures.push_back(load_experiment(find_experiment(name)));
    if (!fixtures.back().experiment.faults.empty()) {
      throw FixtureError({.file = fixtures.back().file.string()}, "an experiment with faults",
                         "one without: the search brings its own");
    }
  }
  return fixtures;
}

// One margin is compared with another's: it is of the same requirement.
Asked asked_of_all(const FalsifyOptions& options, const std::vector<ExperimentFixture>& fixtures) {
  const auto asked = asked_of(options, fixtures.front().experiment);
  for (const auto& fixture : fixtures) {
    const auto other = asked_of(options, fixture.experiment);
    if (other.name() != asked.name() || other.text() != asked.text()) {
      throw FixtureError({.file = fixture.file.string()}, other.name() + ": " + other.text(),
                         asked.name() + ": " + asked.text() + ", as of the first experiment");
    }
  }
  return asked;
}

// Times the number of spaces. With a time for a budget nobody knows how many rounds there will be:
// over many spaces they are short.
std::size_t runs_a_round(const SearchBudget& budget, std::size_t spaces) {
  constexpr std::size_t kMost = 1000;
  if (budget.time_s > 0) {
    constexpr std::size_t kRound = 2000;
    constexpr std::size_t kFewest = 4;
    return std::clamp(kRound / spaces, kFewest, kMost);
  }
  constexpr std::size_t kFewest = 20;
  return std::clamp(budget.runs / spaces, std::min(kFewest, budget.runs), kMost);
}

Search prepare_search(FalsifyOptions& options, const std::vector<ExperimentFixture>& fixtures,
                      const Asked& asked, const CandidateController& controller) {
  Search search{.budget = parse_budget(options.budget), .unit = asked.unit()};
  for (const auto& fixture : fixtures) {
    check_setup(options, fixture, asked, controller);
    search.objectives.push_back(controller.is_bbmc()
                                    ? in_process_objective(fixture, asked, options.snapshots)
                                    : candidate_objective(fixture, asked, controller));
    for (auto& faults : fault_spaces(options, fixture, *search.objectives.back())) {
      search.spaces.push_back({.experiment = search.objectives.size() - 1,
                               .motion = fixtures.size() > 1 ? fixture.experiment.name : "",
                               .faults = std::move(faults)});
    }
  }
  if (search.spaces.empty()) {
    throw FixtureError({.file = "command line", .key = "--faults"},
                       fmt::format("{}", fmt::join(options.faults, ",")),
                       "a fault that is left by --except, on an axis of one of the rigs");
  }
  search.settings = {.runs = search.budget.runs,
                     .runs_a_round = runs_a_round(search.budget, search.spaces.size()),
                     .seed = options.seed,
                     .optimiser = optimiser_named(options.optimiser),
                     .until_broken = options.until_broken};
  search.settings.fingerprint = fingerprint_of(options, fixtures, asked, controller, search);
  return search;
}

std::string name_of(const std::vector<ExperimentFixture>& fixtures) {
  return fixtures.size() == 1 ? fixtures.front().experiment.name
                              : fmt::format("{} experiments", fixtures.size());
}

int execute_falsify(FalsifyOptions& options) {
  const auto shard = parse_shard(options.shard);
  const auto fixtures = searched_experiments(options);
  const auto asked = asked_of_all(options, fixtures);
  const auto controller = candidate_of(options.controller);
  const auto search = prepare_search(options, fixtures, asked, controller);
  if (options.out.empty()) {
    options.out = "runs/falsify" +
                  (fixtures.size() == 1 ? '-' + fixtures.front().experiment.name : std::string());
  }
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  if (options.fresh) {
    remove_trials(folder, shard);
  }
  const auto result = run_search(options, search);
  const auto& session = result.session;
  const auto* worst = session.worst();
  std::optional<ShrunkCase> needed;
  const auto place = worst == nullptr ? 0 : session.spaces()[worst->space].experiment;
  if (worst != nullptr && result.whole) {
    needed = shrink(worst->tried, worst->outcome, *search.objectives[place]);
  }
  const auto text = falsify_report(session, asked, name_of(fixtures), needed ? &*needed : nullptr);
  write_atomically(folder / "falsify.md", text);
  write_atomically(folder / "spaces.csv", spaces_csv(session));
  if (!options.quiet) {
    std::fputs(text.c_str(), stdout);
  }
  if (!result.whole) {
    std::printf("%s after %zu runs; the same command goes on\n",
                stop_requested() ? "interrupted" : "other parts are not complete",
                session.trials().size());
    return kExitRuntime;
  }
  if (!needed) {
    std::printf("INVALID  %s: no fault took effect, so nothing was tried\n",
                name_of(fixtures).c_str());
    return kExitInvalid;
  }
  return report_worst(options, fixtures[place], asked, controller, *needed);
}

}  // namespace

void add_falsify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<FalsifyOptions>();
  auto* verb =
      app.add_subcommand("falsify", "search the faults and setups that break a requirement");
  verb->add_option("experiment", options->experiments,
                   "names of experiments of fixtures/experiments, or paths; several are one search")
      ->required();
  verb->add_option("--requirement", options->requirement,
                   "id of a [[requirement]], or rules: what holds whatever fails [the one with "
                   "under_faults, else rules]");
  verb->add_option(
          "--faults", options->faults,
          "kinds, places or \"PLACE KIND\", separated by commas; none: the setup alone [all]")
      ->delimiter(',');
  verb->add_option("--except", options->except,
                   "of these, what is left out: known already, and the search is for others")
      ->delimiter(',');
  verb->add_option("--second", options->second, "a second fault in every run: \"PLACE KIND\"");
  verb->add_option("--machine", options->setup.machine,
                   "a machine that differs: what the campaign draws, each up to so much, relative")
      ->check(CLI::Range(0.0, 0.5));
  verb->add_option("--start", options->setup.start_m,
                   "each axis starts up to so many metres to either side")
      ->check(CLI::Range(0.0, 10.0));
  verb->add_option("--speed", options->speed, "FROM TO: times the speed of the motions")
      ->expected(2);
  verb->add_option("--typed", options->setup.typed,
                   "a line that an operator types at any moment, such as \"stop\"");
  verb->add_option("--budget", options->budget, "\"2000 runs\", or a time: \"10 min\"")
      ->capture_default_str();
  verb->add_option("--optimiser", options->optimiser,
                   "what chooses behind the samples: sbplx, crs2, direct, esch; uniform: nothing "
                   "does, and all samples are uniform")
      ->capture_default_str();
  verb->add_option("--controller", options->controller,
                   "instead of BBMC: process:\"COMMAND {address}\" or firmware:IMAGE.elf");
  verb->add_option("--seed", options->seed, "of the search")->check(whole_number());
  verb->add_option("--snapshots", options->snapshots,
                   "moments from which runs in this process go on; 0: each begins anew")
      ->check(CLI::Range(0, 200))
      ->capture_default_str();
  auto* workers =
      verb->add_option("--workers", options->workers,
                       "parts side by side, each with its own seed and an equal share of the runs");
  workers->check(CLI::Range(1, 1000))->capture_default_str();
  auto* part = verb->add_option("--shard", options->shard,
                                "i/n: the i-th of n parts alone; --workers n then puts together");
  auto* slurm = verb->add_option("--slurm", options->slurm,
                                 "parts as a Slurm job array; --out is seen by all nodes");
  slurm->check(CLI::Range(1, 10000));
  part->capture_default_str()->excludes(workers)->excludes(slurm);
  workers->excludes(slurm);
  verb->add_option("--slurm-option", options->slurm_options,
                   "one more #SBATCH line, such as --partition=main")
      ->needs(slurm);
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
