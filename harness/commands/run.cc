// towbench run: one or several experiments, judged.
#include <cstdio>
#include <fstream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "harness/commands/command.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/verdict_table.h"
#include "harness/experiment/board_plan_text.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_paths.h"

namespace towbench::harness {
namespace {

struct RunVerbOptions {
  std::vector<std::string> experiments;
  std::vector<std::string> faults;
  std::string fault_plan;
  ExperimentOptions shared;
};

nlohmann::json result_of(const RunResult& run) {
  std::ifstream stream(run.folder / "result.json");
  auto result = nlohmann::json::parse(stream);
  result["folder"] = run.folder.string();
  return result;
}

FaultPlan plan_of(const RunVerbOptions& options) {
  FaultPlan plan;
  if (!options.fault_plan.empty()) {
    plan = read_fault_plan(FixtureFile::load(options.fault_plan));
  }
  for (const auto& words : options.faults) {
    if (!is_board_fault(words)) {
      plan.push_back(parse_fault(words));
    }
  }
  return plan;
}

int execute_run(const RunVerbOptions& options) {
  // All fixtures first: a slip in the last file is told before the first run.
  std::vector<ExperimentFixture> fixtures;
  const auto plan = plan_of(options);
  for (const auto& named : options.experiments) {
    fixtures.push_back(load_experiment(find_experiment(named)));
    add_faults(fixtures.back(), plan);
    for (const auto& words : options.faults) {
      if (is_board_fault(words)) {
        add_board_fault(fixtures.back(), parse_board_fault(words));
      }
    }
  }
  int exit_code = kExitPass;
  auto results = nlohmann::json::array();
  for (const auto& fixture : fixtures) {
    const auto run = run_with_options(fixture, options.shared);
    exit_code = graver(exit_code, run.exit_code);
    if (options.shared.json) {
      results.push_back(result_of(run));
      continue;
    }
    const bool say = !options.shared.quiet || run.exit_code != kExitPass;
    if (say) {
      std::fputs(verdict_table(fixture.experiment.name, run, !options.shared.quiet).c_str(),
                 stdout);
    }
    const auto last = options.shared.no_report ? run.folder : run.folder / "report.html";
    std::printf("%s\n", last.c_str());
    std::fflush(stdout);
    if (!run.complete) {
      break;
    }
  }
  if (options.shared.json) {
    std::printf("%s\n", (results.size() == 1 ? results[0] : results).dump(2).c_str());
  }
  return exit_code;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunVerbOptions>();
  auto* verb = app.add_subcommand("run", "run experiments and judge them");
  verb->add_option("experiment", options->experiments,
                   "name of an experiment of fixtures/experiments, or a path")
      ->required();
  verb->add_option("--fault", options->faults,
                   "break something: \"PART KIND at=TIME ...\"; may be repeated")
      ->take_all();
  verb->add_option("--fault-plan", options->fault_plan, "break what this file says");
  add_experiment_options(*verb, options->shared);
  verb->footer(
      "Example: towbench run trapezoid-400 --carrier local --out runs\n"
      "         towbench run trapezoid-400 --fault \"encoder.y frozen phase=cruise after=0.5s\"\n"
      "Guides: docs/guide/experiments.md, faults.md, your-controller.md, run-your-firmware.md");
  verb->callback([options, &exit_code] { exit_code = execute_run(*options); });
}

}  // namespace towbench::harness
