// towbench falsify: the faults with which a requirement comes nearest to breaking.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/command.h"
#include "harness/commands/falsify_options.h"
#include "harness/commands/falsify_worst.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/falsify/falsify_report.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

std::vector<FaultSpace> spaces_of(const FalsifyOptions& options, const ExperimentFixture& fixture,
                                  double end_s) {
  core::PerAxis<bool> exists;
  for (const auto axis : core::kAxes) {
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
  for (const auto& choice : fault_choices(options.faults, exists)) {
    if (second.empty()) {
      spaces.emplace_back(std::vector{choice}, end_s, setup);
    }
    for (const auto& other : second) {
      spaces.emplace_back(std::vector{choice, other}, end_s, setup);
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
           fmt::format("{} {} {} {}", options.seed, runs_a_round, options.until_broken,
                       options.setup.typed));
  for (const auto& space : spaces) {
    hash.add(space.name());
    for (const auto& variable : space.variables()) {
      hash.add(fmt::format("{} {} {}", variable.name, variable.from, variable.to));
    }
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

int execute_falsify(FalsifyOptions& options) {
  const auto budget = parse_budget(options.budget);
  const auto fixture = load_experiment(find_experiment(options.experiment));
  const auto asked = asked_of(options, fixture.experiment);
  const auto controller = candidate_of(options.controller);
  if (!fixture.experiment.faults.empty()) {
    throw FixtureError({.file = fixture.file.string()}, "an experiment with faults",
                       "one without: the search brings its own");
  }
  check_setup(options, fixture, asked, controller);
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
  const auto* worst = session.worst();
  const bool interrupted = !whole && stop_requested();
  std::optional<ShrunkCase> needed;
  if (worst != nullptr && !interrupted) {
    needed = shrink(worst->tried, worst->outcome, *objective);
  }
  const auto text =
      falsify_report(session, asked, fixture.experiment.name, needed ? &*needed : nullptr);
  write_atomically(folder / "falsify.md", text);
  if (!options.quiet) {
    std::fputs(text.c_str(), stdout);
  }
  if (interrupted) {
    std::printf("interrupted after %zu runs; the same command goes on\n", session.trials().size());
    return kExitRuntime;
  }
  if (!needed) {
    std::printf("INVALID  %s: no fault took effect, so nothing was tried\n",
                fixture.experiment.name.c_str());
    return kExitInvalid;
  }
  return report_worst(options, fixture, asked, controller, *needed);
}

}  // namespace

void add_falsify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<FalsifyOptions>();
  auto* verb =
      app.add_subcommand("falsify", "search the faults and setups that break a requirement");
  verb->add_option("experiment", options->experiment,
                   "name of an experiment of fixtures/experiments, or a path")
      ->required();
  verb->add_option("--requirement", options->requirement,
                   "id of a [[requirement]], or rules: what holds whatever fails [the one with "
                   "under_faults, else rules]");
  verb->add_option(
          "--faults", options->faults,
          "kinds, places or \"PLACE KIND\", separated by commas; none: the setup alone [all]")
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
