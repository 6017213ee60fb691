// towbench results: docs/measurements/results.md, from one run of everything that has a table in
// the thesis.
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "study/commands/verbs.h"
#include "study/procedures/kept_outcome.h"
#include "study/procedures/procedures.h"
#include "study/procedures/sequence.h"
#include "study/recovery/tow/tow_recovery.h"
#include "study/results/kept_tow.h"
#include "study/results/results_page.h"
#include "study/results/thesis_tracking.h"

namespace towbench::study {
namespace {

struct ResultsOptions {
  std::string out;  // empty: results.md of the work folder
  std::string work = "identified";
  std::uint64_t seed = 1;
};

struct ResultsBench {
  harness::RigFixture dry;
  harness::RigFixture wet;
  harness::ControllerFixture controller;
  harness::LoopWatchers watchers;
  std::string fingerprint;  // of what is run, apart from the program and the settings
};

void measure_tracking(const ResultsBench& bench, Results& results) {
  const auto slow = speeds_of(kTable7_6);
  const auto fast = speeds_of(kTable8_3);
  const TrapezoidRun smoothed{.smooth_s = 0.243, .settle_s = 0.3};
  const auto straight = [&](double ramp_s) {
    const TrapezoidRun ramp{.acceleration_s = ramp_s, .settle_s = smoothed.settle_s};
    constexpr std::array kSlowest_m_per_s{0.05};
    return track_speeds(bench.dry, bench.controller, kSlowest_m_per_s, ramp, {}).front();
  };
  results.straight_ramps = {straight(smoothed.acceleration_s), straight(0.3)};
  results.slow = track_speeds(bench.dry, bench.controller, slow, {}, {});
  results.fast_air = track_speeds(bench.dry, bench.controller, fast, smoothed, {});
  results.fast_water = track_speeds(bench.wet, bench.controller, fast, smoothed, {});
}

void measure_own_gains(const ResultsBench& bench, harness::ProgressLine& progress,
                       Results& results) {
  double done = 0;
  for (const char* name : {"bbmc-table-7.2", "bbmc-0.5", "bbmc-tuned"}) {
    progress.show("Tables 7.6 and 8.3 with " + std::string(name), done / 3);
    harness::SourceFiles sources;
    results.own_gains.push_back(track_gains(
        bench.dry, harness::load_controller(harness::fixtures_directory() / "controllers" /
                                                (std::string(name) + ".toml"),
                                            sources)));
    done += 1;
  }
}

void identify_machine(const ResultsBench& bench, const ResultsOptions& options,
                      harness::ProgressLine& progress, Results& results) {
  const procedures::Machine machine(bench.dry, bench.controller, options.seed, bench.watchers);
  procedures::SequenceOptions sequence;
  sequence.settings = harness::fixtures_directory() / "identification";
  sequence.out = options.work;
  sequence.fingerprint = bench.fingerprint;
  sequence.resume = true;
  sequence.stop = &harness::stop_requested();
  sequence.progress = [&](const std::string& what, double share) { progress.show(what, share); };
  results.identified =
      procedures::run_sequence(machine, procedures::identification_procedures(), sequence);
}

procedures::TowOutcome tow_once(const procedures::TowLoads& loads,
                                const procedures::TowProcedure& procedure,
                                const std::filesystem::path& file, const std::string& fingerprint,
                                harness::ProgressLine& progress) {
  if (const auto before = procedures::kept_outcome(file, fingerprint)) {
    return tow_from_json(*before);
  }
  const std::string id(procedure.id());
  auto settings = harness::fixtures_directory() / "tow" / (id + ".toml");
  if (!std::filesystem::exists(settings)) {
    settings.clear();
  }
  auto outcome =
      procedure.run({.loads = loads, .settings = settings, .progress = [&](double share) {
                       progress.show(id + " " + std::string(procedure.title()), share);
                     }});
  if (outcome.status != procedures::ProcedureOutcome::Status::kFailed) {
    procedures::keep_outcome(file, fingerprint, tow_to_json(outcome));
  }
  return outcome;
}

void tow_everything(const ResultsBench& bench, const ResultsOptions& options,
                    harness::ProgressLine& progress, Results& results) {
  const auto rigs = harness::fixtures_directory() / "rigs";
  const procedures::TowLoads loads(bench.dry, bench.controller, options.seed, rigs, bench.watchers);
  for (const auto& procedure : procedures::tow_procedures()) {
    if (harness::stop_requested()) {
      return;
    }
    const std::string id(procedure->id());
    const auto fingerprint = fmt::format(
        "{}-{}-{}-{}", procedures::program_fingerprint(), bench.fingerprint,
        procedures::file_fingerprint(harness::fixtures_directory() / "tow" / (id + ".toml")),
        procedures::file_fingerprint(rigs / (procedure->load().rig + ".toml")));
    auto outcome = tow_once(loads, *procedure,
                            std::filesystem::path(options.work) / "done" / ("tow-" + id + ".json"),
                            fingerprint, progress);
    auto recoveries = judge_tow(loads.truth(procedure->load()), outcome);
    results.tows.push_back(
        {id, std::string(procedure->title()), std::move(outcome), std::move(recoveries)});
  }
}

int code_of(const Results& results) {
  const auto is_done = [](const procedures::ProcedureOutcome& outcome) {
    return outcome.status == procedures::ProcedureOutcome::Status::kDone;
  };
  for (const auto& step : results.identified.steps) {
    if (!is_done(step.outcome)) {
      return harness::kExitInvalid;
    }
  }
  for (const auto& tow : results.tows) {
    if (!is_done(tow.outcome)) {
      return harness::kExitInvalid;
    }
  }
  return harness::kExitPass;
}

int execute_results(const ResultsOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto fixtures = harness::fixtures_directory();
  harness::SourceFiles sources;
  ResultsBench bench{
      .dry = harness::load_rig(fixtures / "rigs" / "tow-dry.toml", sources),
      .wet = harness::load_rig(fixtures / "rigs" / "tow-cylinder.toml", sources),
      .controller = harness::load_controller(fixtures / "controllers" / "bbmc-tuned.toml", sources),
      .watchers = {.stop = &harness::stop_requested(), .progress = {}},
      .fingerprint = {}};
  bench.fingerprint =
      fmt::format("{:016x}-{:016x}-{}", bench.dry.hash, bench.controller.hash, options.seed);
  harness::ProgressLine progress(true);
  Results results;
  results.rig = bench.dry.name;
  results.truth = bench.dry.parameters;
  progress.show("Tables 7.6 and 8.3", 0);
  measure_tracking(bench, results);
  measure_own_gains(bench, progress, results);
  identify_machine(bench, options, progress, results);
  tow_everything(bench, options, progress, results);
  progress.clear();
  if (harness::stop_requested()) {
    fmt::print("interrupted; the same command continues\n");
    return harness::kExitInvalid;
  }
  const auto out = options.out.empty() ? std::filesystem::path(options.work) / "results.md"
                                       : std::filesystem::path(options.out);
  harness::write_atomically(out, results_page(results));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  fmt::print("{}\n{:.0f} s of wall clock\n", out.string(), took.count());
  return code_of(results);
}

}  // namespace

void add_results(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ResultsOptions>();
  auto* verb = app.add_subcommand("results", "the thesis's tables: thesis, bench, truth");
  verb->add_option("--out", options->out, "file to write; results.md of --work if not given");
  verb->add_option("--work", options->work, "folder of the identification; what is done stays")
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "of the sensors' noise and of where things stand")
      ->check(harness::whole_number());
  verb->footer(
      "Example: towbench results --out docs/measurements/results.md\n"
      "Exit: 0 written, 4 written, but an experiment was refused or its data are no good.");
  verb->callback([options, &exit_code] { exit_code = execute_results(*options); });
}

}  // namespace towbench::study
