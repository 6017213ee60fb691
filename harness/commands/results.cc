// towbench results: docs/results.md, from one run of everything that has a table in the thesis.
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/command.h"
#include "harness/commands/fixture_paths.h"
#include "harness/commands/stop_signal.h"
#include "harness/judge/check.h"
#include "harness/judge/tow_recovery.h"
#include "harness/procedures/chain.h"
#include "harness/procedures/procedures.h"
#include "harness/record/line_writer.h"
#include "harness/results/results_page.h"

namespace towbench::harness {
namespace {

struct Options {
  std::string out = "results.md";
  std::string work = "identified";
  std::uint64_t seed = 1;
};

std::vector<TrackedSpeed> tracked(const RigFixture& rig, const ControllerFixture& controller,
                                  std::initializer_list<double> speeds, TrapezoidRun run) {
  std::vector<TrackedSpeed> all;
  for (const double speed : speeds) {
    run.speed_m_per_s = speed;
    // Three seconds of steady motion, or what the track allows.
    run.distance_m = std::min(2.2, speed * (run.acceleration_s + run.smooth_s + 3.0));
    all.push_back({speed, track_trapezoid(rig, controller, run, 1)});
  }
  return all;
}

int execute(const Options& options) {
  const auto fixtures = fixtures_directory();
  SourceFiles sources;
  const auto dry = load_rig(fixtures / "rigs" / "tow-dry.toml", sources);
  const auto wet = load_rig(fixtures / "rigs" / "tow-cylinder.toml", sources);
  const auto controller = load_controller(fixtures / "controllers" / "bbmc-tuned.toml", sources);
  const LoopWatchers watchers{.stop = &stop_requested(), .progress = {}};

  Results results;
  results.rig = dry.name;
  results.truth = dry.parameters;
  results.slow = tracked(dry, controller,
                         {0.005, 0.010, 0.020, 0.030, 0.040, 0.050, 0.060, 0.070, 0.080, 0.090,
                          0.100, 0.200, 0.300, 0.400},
                         {});
  const TrapezoidRun fast{.smooth_s = 0.243, .settle_s = 0.3};
  results.fast_air = tracked(dry, controller, {0.05, 0.15, 0.25, 0.35, 0.45, 0.55}, fast);
  results.fast_water = tracked(wet, controller, {0.05, 0.15, 0.25, 0.35, 0.45, 0.55}, fast);

  const procedures::Machine machine(dry, controller, options.seed, watchers);
  procedures::ChainOptions options_of_chain;
  options_of_chain.settings = fixtures / "identification";
  options_of_chain.out = options.work;
  options_of_chain.fingerprint =
      fmt::format("{:016x}-{:016x}-{}", dry.hash, controller.hash, options.seed);
  options_of_chain.resume = true;
  const auto chain =
      procedures::run_chain(machine, procedures::identification_procedures(), options_of_chain);
  results.identified = chain.estimates;

  const procedures::TowLoads loads(dry, controller, options.seed, fixtures / "rigs", watchers);
  int code = kExitPass;
  for (const auto& procedure : procedures::tow_procedures()) {
    auto outcome = procedure->run({.loads = loads});
    auto recoveries = judge_tow(loads.truth(procedure->load()), outcome);
    if (outcome.status != procedures::ProcedureOutcome::Status::kDone) {
      code = kExitInvalid;
    }
    results.tows.push_back({std::string(procedure->id()), std::string(procedure->title()),
                            std::move(outcome), std::move(recoveries)});
  }
  write_atomically(options.out, results_page(results));
  fmt::print("{}\n", options.out);
  return code;
}

}  // namespace

void add_results(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("results", "the thesis's tables: thesis, bench, truth");
  verb->add_option("--out", options->out, "file to write");
  verb->add_option("--work", options->work, "folder of the identification; what is done stays");
  verb->add_option("--seed", options->seed, "of the sensors' noise and of where things stand");
  verb->footer(
      "Example: towbench results --out docs/results.md\n"
      "Exit: 0 written, 4 written, but an experiment was refused or its data are no good.");
  verb->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace towbench::harness
