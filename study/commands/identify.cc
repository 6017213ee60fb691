// towbench identify: what a machine's parameters are, from experiments on it.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/checks/check.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "study/commands/identified_controller_file.h"
#include "study/commands/identify_camera.h"
#include "study/commands/identify_output.h"
#include "study/commands/verbs.h"
#include "study/procedures/data_study.h"
#include "study/procedures/identified_plant.h"
#include "study/procedures/sequence.h"
#include "study/procedures/study_page.h"
#include "study/recovery/recovery.h"
#include "study/results/identification_set.h"
#include "study/results/set_up_tracking.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;
using procedures::SequenceResult;

constexpr double kSpread = 0.4;  // of drawn machines, ID-0
constexpr const char* kAllStructures = "all";
constexpr std::uint64_t kDrawnOfStructures = 10;  // machines that the seeds of a structure go round

struct IdentifyOptions {
  std::string rig;
  std::string controller;
  std::string settings;
  std::string axis = "both";
  std::vector<std::string> only;
  std::string out = "identified";
  std::uint64_t seed = 1;
  bool resume = false;
  bool quiet = false;
  bool json = false;
  bool blind = false;
  bool track = false;
  std::string camera;
  std::string data;
  std::string columns;
  std::string structure;
  std::uint64_t drawn = 0;
  std::uint64_t machine = 0;
  std::uint64_t seeds = 1;
  std::size_t workers = 1;
};

std::vector<core::Axis> axes_of(const std::string& axis) {
  if (axis == "both") {
    return {core::Axis::kY, core::Axis::kX};
  }
  return {axis == "y" ? core::Axis::kY : core::Axis::kX};
}

void refuse_unknown(const std::vector<std::string>& only,
                    const std::vector<std::unique_ptr<procedures::Procedure>>& all) {
  for (const auto& id : only) {
    std::string ids;
    bool known = false;
    for (const auto& each : all) {
      known = known || each->id() == id;
      ids += (ids.empty() ? "" : " ") + std::string(each->id());
    }
    if (!known) {
      throw harness::FixtureError({.file = "--only"}, id, ids);
    }
  }
}

std::vector<std::string> structure_names() {
  std::vector<std::string> names{kAllStructures};
  for (const auto& each : foreign_structures()) {
    names.emplace_back(each.name);
  }
  return names;
}

int exit_code_of(const SequenceResult& result, const std::vector<Recovery>& recoveries) {
  int code = result.steps.empty() ? harness::kExitInvalid : harness::kExitPass;
  for (const auto& each : recoveries) {
    if (!each.agrees || !each.narrow) {
      code = harness::kExitFail;
    }
  }
  for (const auto& step : result.steps) {
    if (step.outcome.status == ProcedureOutcome::Status::kFailed) {
      return harness::kExitInvalid;
    }
    if (step.outcome.status == ProcedureOutcome::Status::kRefused) {
      code = harness::kExitInvalid;
    }
  }
  return code;
}

// What the command line names, read.
struct Bench {
  harness::RigFixture rig;
  harness::ControllerFixture controller;
  std::filesystem::path settings;
};

Bench bench_of(const IdentifyOptions& options) {
  const auto fixtures = harness::fixtures_directory();
  const auto named = [&](const std::string& given, const char* folder, const char* standard) {
    return given.empty() ? fixtures / folder / standard : std::filesystem::path(given);
  };
  harness::SourceFiles sources;
  return {.rig = harness::load_rig(named(options.rig, "rigs", "tow-dry.toml"), sources),
          .controller = harness::load_controller(
              named(options.controller, "controllers", "bbmc-tuned.toml"), sources),
          .settings = options.settings.empty() ? fixtures / "identification"
                                               : std::filesystem::path(options.settings)};
}

int tell_everything(const IdentifyOptions& options, const std::string& title,
                    const procedures::Machine& machine, SequenceResult result,
                    const std::vector<Recovery>& recoveries) {
  const std::filesystem::path out = options.out;
  identify::write_estimates(out / "estimates.json", result.estimates);
  write_plant(out, procedures::identified_plant(machine, result.estimates), result);
  write_identified_controller(out / "identified_controller.toml", machine, result.estimates);
  harness::write_atomically(out / "report.html", procedures::study_page(title, result, recoveries));
  if (options.json) {
    fmt::print("{}\n", identify::to_json(result.estimates).dump(2));
  } else {
    if (!options.quiet) {
      tell_steps(result);
      tell_estimates(result.estimates, recoveries);
    }
    fmt::print("{}\n", (out / "report.html").string());
  }
  return exit_code_of(result, recoveries);
}

// Nothing is moved and no truth is near: the log is all there is.
int execute_on_log(const IdentifyOptions& options, const Bench& bench) {
  if (options.axis == "both") {
    throw harness::FixtureError({.file = "--axis"}, "nothing", "y or x: whose log it is");
  }
  const auto axis = axes_of(options.axis).front();
  const procedures::Machine machine(bench.rig, bench.controller, options.seed);
  const auto log =
      procedures::read_brought_log(options.data, options.columns, axis, machine.nameplate(axis));
  std::filesystem::create_directories(options.out);
  harness::ProgressLine progress(!options.quiet);
  progress.show("output error on " + log.source, 0);
  SequenceResult result;
  procedures::SequenceStep step{.id = "log", .title = log.source};
  step.axis = axis;
  step.outcome = procedures::study_log({.machine = machine, .axis = axis}, log);
  result.estimates = step.outcome.estimates;
  result.steps.push_back(std::move(step));
  progress.clear();
  return tell_everything(options, "Identification from " + options.data, machine, std::move(result),
                         {});
}

int execute_set(const IdentifyOptions& options, const Bench& bench) {
  harness::ProgressLine progress(!options.quiet);
  IdentificationSet set{.rig = bench.rig,
                        .controller = bench.controller,
                        .settings = bench.settings,
                        .out = options.out,
                        .machines = options.drawn > 0 ? options.drawn : kDrawnOfStructures,
                        .seeds = options.seeds,
                        .spread = kSpread,
                        .workers = options.workers,
                        .axes = axes_of(options.axis),
                        .stop = &harness::stop_requested(),
                        .progress = [&](std::size_t done, std::size_t all) {
                          progress.show(fmt::format("{} of {} runs", done, all),
                                        static_cast<double>(done) / static_cast<double>(all));
                        }};
  const bool foreign = options.structure == kAllStructures;
  if (foreign) {
    set.structures = foreign_structures();
  }
  const auto runs = run_set(set);
  progress.clear();
  const auto page = foreign ? foreign_page(set, runs) : set_page(set, runs);
  harness::write_atomically(set.out / "set.md", page);
  fmt::print("{}{}\n", options.quiet ? "" : page, (set.out / "set.md").string());
  int code = harness::kExitPass;
  for (const auto& run : runs) {
    if (!run.done || !run.not_done.empty()) {
      return harness::kExitInvalid;
    }
    for (const auto& each : run.recoveries) {
      code = each.agrees && each.narrow ? code : harness::kExitFail;
    }
  }
  return code;
}

int execute_identify(const IdentifyOptions& options) {
  if (!options.camera.empty()) {
    return tell_elastic_error(options.camera, options.json);
  }
  auto bench = bench_of(options);
  if (!options.data.empty()) {
    return execute_on_log(options, bench);
  }
  if (options.drawn > 0 || options.structure == kAllStructures) {
    return execute_set(options, bench);
  }
  const auto all = procedures::identification_procedures();
  refuse_unknown(options.only, all);
  const auto drawn =
      drawn_rig(bench.rig, options.machine, kSpread, find_structure(options.structure));
  bench.rig = drawn.truth;
  std::filesystem::create_directories(options.out);
  const harness::LoopWatchers watchers{.stop = &harness::stop_requested(), .progress = {}};
  const auto machine = drawn.machine(bench.controller, options.seed, watchers);
  harness::ProgressLine progress(!options.quiet);
  const procedures::SequenceOptions sequence{
      .only = options.only,
      .axes = axes_of(options.axis),
      .settings = bench.settings,
      .out = options.out,
      .fingerprint = fmt::format("{:016x}-{:016x}-{}-{}{}", bench.rig.hash, bench.controller.hash,
                                 options.machine, options.seed, options.structure),
      .resume = options.resume,
      .progress = [&](const std::string& what, double share) { progress.show(what, share); },
      .stop = &harness::stop_requested()};
  auto result = procedures::run_sequence(machine, all, sequence);
  if (options.track && !harness::stop_requested()) {
    progress.show("Table 7.6 with the controller set up", 0);
    const auto name = options.machine == 0
                          ? fmt::format("`{}`", bench.rig.name)
                          : fmt::format("{} drawn within {:.0f} % of `{}`", options.machine,
                                        100 * kSpread, bench.rig.name);
    harness::write_atomically(
        std::filesystem::path(options.out) / "tracking.md",
        set_up_section(name, track_set_up(bench.rig, machine, result.estimates)));
  }
  progress.clear();
  // Only now may anybody look at what the machine is.
  const auto recoveries = options.blind ? std::vector<Recovery>{}
                                        : judge_recovery(bench.rig.parameters, result.estimates);
  return tell_everything(options, "Identification of " + bench.rig.name, machine, std::move(result),
                         recoveries);
}

}  // namespace

void add_identify(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<IdentifyOptions>();
  auto* verb = app.add_subcommand("identify", "find a machine's parameters by experiments on it");
  verb->add_option("rig", options->rig, "rig file; fixtures/rigs/tow-dry.toml if not given")
      ->check(CLI::ExistingFile);
  verb->add_option("--only", options->only, "this experiment only (EXP-P-3); may be repeated");
  verb->add_option("--axis", options->axis, "y, x or both")
      ->check(CLI::IsMember({"y", "x", "both"}));
  verb->add_option("--controller", options->controller, "controller file")
      ->check(CLI::ExistingFile);
  verb->add_option("--settings", options->settings, "folder of the experiments' own files")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--seed", options->seed, "of the sensors' noise and of where things stand")
      ->check(harness::whole_number());
  verb->add_option("--out", options->out, "folder to write to")->check(harness::folder_to_write());
  verb->add_flag("--resume", options->resume, "continue what was interrupted in that folder");
  verb->add_flag("--blind", options->blind, "do not set the rig's own parameters beside");
  auto* track =
      verb->add_flag("--track", options->track,
                     "tracking.md too: Table 7.6 with BBMC set up from what was found, and homed");
  verb->add_flag("--quiet", options->quiet, "no progress, no tables");
  verb->add_flag("--json", options->json, "print estimates.json");
  verb->add_option("--data", options->data,
                   "estimate from this log instead: a run folder, BBMC's data log, a CSV file");
  verb->add_option(
          "--camera", options->camera,
          "the transmission's elastic error instead, from encoder and camera of this run folder")
      ->check(CLI::ExistingDirectory)
      ->excludes("--data");
  verb->add_option("--columns", options->columns, "which column of that CSV is what, TOML")
      ->check(CLI::ExistingFile)
      ->needs("--data");
  track->excludes("--data");
  verb->add_option("--drawn", options->drawn,
                   "so many machines, the first nominal, the rest drawn within 40 %")
      ->check(CLI::Range(1, 1000))
      ->excludes(track);
  verb->add_option("--machine", options->machine,
                   "the machine of that number in such a set, 0: the rig itself")
      ->check(CLI::Range(0, 999));
  verb->add_option("--structure", options->structure,
                   "the machine with what no estimator assumes, or all of them as a set")
      ->check(CLI::IsMember(structure_names()));
  verb->add_option("--seeds", options->seeds, "with --drawn: seeds of each")
      ->check(harness::whole_number())
      ->check(CLI::Range(1, 10000));
  verb->add_option("--workers", options->workers, "with --drawn: processes at once")
      ->check(harness::whole_number())
      ->check(CLI::Range(1, 256));
  verb->footer(
      "Example: towbench identify fixtures/rigs/tow-dry.toml --out identified\n"
      "         towbench identify --data log.csv --axis y --columns map.toml\n"
      "         towbench identify --camera runs/20260101T120000Z-1-0f3a\n"
      "         towbench identify --machine 2 --axis x --only EXP-P-1 --only EXP-P-3\n"
      "         towbench identify --drawn 10 --seeds 40 --workers 2 --out set   (hours; "
      "continues)\n"
      "         towbench identify --structure all --seeds 5 --workers 2 --out foreign\n"
      "Writes estimates.json, report.html, identified_plant.toml (rejected_plant.toml where what "
      "is\n"
      "found contradicts a document or a belief), identified_controller.toml.\n"
      "--camera writes nothing. Exit: 0 all experiments done,\n"
      "1 an estimate misses the emulated machine's own value by more than its demand allows,\n"
      "2 bad arguments, 4 an experiment was refused or its data are no good.");
  verb->callback([options, &exit_code] { exit_code = execute_identify(*options); });
}

}  // namespace towbench::study
