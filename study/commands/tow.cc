// towbench tow: the tow experiments of chapter 8 on an emulated machine, judged.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "harness/checks/check.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "study/commands/tow_set.h"
#include "study/commands/tow_sources.h"
#include "study/commands/verbs.h"
#include "study/procedures/study_page.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/recovery/tow/tow_recovery.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;

void tell(const std::string& id, const std::string& title, const procedures::TowOutcome& outcome,
          double wall_s) {
  const char* word = outcome.status == ProcedureOutcome::Status::kDone      ? "done"
                     : outcome.status == ProcedureOutcome::Status::kRefused ? "refused"
                                                                            : "FAILED";
  fmt::print("{:<12} {:<8} {:<52} {:.1f} s {}\n", id, word, title, wall_s, outcome.reason);
  for (const auto& table : outcome.tables) {
    fmt::print("  {}\n", table.title);
    for (const auto& row : table.rows) {
      fmt::print("    {}\n", fmt::join(row, " | "));
    }
  }
}

void tell(const Recovery& r) {
  const auto& e = r.estimate;
  const auto place = e.at ? fmt::format(" @{:.3g}", *e.at) : "";
  const auto interval = e.no_interval.empty() ? fmt::format("[{:.5g}, {:.5g}]", e.low, e.high)
                                              : std::string("[withheld]");
  const auto demand = r.tolerance_pct > 0 ? fmt::format(" (of {} %)", r.tolerance_pct) : "";
  fmt::print("  {:<40}{:>11.5g} {}  expected {:.5g}, {:+.2f} %{}{}{}\n", e.quantity + place,
             e.value, interval, r.truth, r.error_pct, demand, r.agrees ? "" : " MISSED",
             r.narrow ? "" : " TOO WIDE");
}

void refuse_unknown(const std::vector<std::string>& only) {
  const auto all = procedures::tow_procedures();
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

int code_of(const procedures::TowOutcome& outcome, const std::vector<Recovery>& judged) {
  if (outcome.status != ProcedureOutcome::Status::kDone) {
    return harness::kExitInvalid;
  }
  for (const auto& each : judged) {
    if (!each.agrees || !each.narrow) {
      return harness::kExitFail;
    }
  }
  return harness::kExitPass;
}

int execute_drawn(const TowOptions& options, const TowSetup& setup) {
  harness::ProgressLine progress(!options.run.quiet);
  return execute_tow_set({.rig = setup.rig,
                          .controller = setup.controller,
                          .rigs = harness::fixtures_directory() / "rigs",
                          .settings = setup.settings,
                          .out = options.run.out,
                          .only = options.only,
                          .machines = options.drawn,
                          .seeds = options.seeds,
                          .workers = options.workers,
                          .stop = &harness::stop_requested(),
                          .progress =
                              [&](std::size_t done, std::size_t all) {
                                progress.show(fmt::format("{} of {} runs", done, all),
                                              static_cast<double>(done) / static_cast<double>(all));
                              }},
                         options.run.quiet);
}

// One experiment's part of the page and of the exit code.
struct TowSession {
  procedures::SequenceResult shown;
  std::vector<Recovery> recoveries;
  int code = harness::kExitPass;
};

void run_one(const procedures::TowProcedure& procedure, const TowSetup& setup, TowSources& sources,
             const TowOptions& options, TowSession& session) {
  const std::string id(procedure.id());
  const bool talks = !options.run.quiet && !options.run.json;
  auto settings = setup.settings / (id + ".toml");
  if (!std::filesystem::exists(settings)) {
    settings.clear();
  }
  if (options.data.empty() && !options.no_runs) {
    keep_setup(setup, settings, options.run.out);
  }
  const auto source = sources.of(id);
  const procedures::TowLoads loads(setup.rig, setup.controller, options.run.seed.value_or(1),
                                   harness::fixtures_directory() / "rigs",
                                   {.stop = &harness::stop_requested(), .progress = {}},
                                   source.get());
  harness::ProgressLine progress(talks);
  auto outcome =
      procedure.run({.loads = loads, .settings = settings, .progress = [&](double share) {
                       progress.show(id, share);
                     }});
  const double wall_s = progress.elapsed_s();
  progress.clear();
  sources.write_list();
  // Only now may anybody look at what is in the water; of a record nobody knows.
  const auto judged = options.data.empty() ? judge_tow(loads.truth(procedure.load()), outcome)
                                           : std::vector<Recovery>{};
  session.code = std::max(session.code, code_of(outcome, judged));
  for (auto& each : outcome.estimates) {
    each.procedure = id;
  }
  if (talks) {
    tell(id, std::string(procedure.title()), outcome, wall_s);
    for (const auto& each : judged) {
      tell(each);
    }
  }
  session.recoveries.insert(session.recoveries.end(), judged.begin(), judged.end());
  auto& shown = session.shown;
  shown.estimates.insert(shown.estimates.end(), outcome.estimates.begin(), outcome.estimates.end());
  shown.steps.push_back(
      {id, std::string(procedure.title()), core::Axis::kY, std::move(outcome), false, wall_s});
}

int execute_tow(const TowOptions& options) {
  refuse_unknown(options.only);
  refuse_together(options);
  const auto setup = setup_of(options);
  if (options.drawn > 0) {
    return execute_drawn(options, setup);
  }
  TowSources sources(options);
  const std::filesystem::path out = options.run.out;
  std::filesystem::create_directories(out);
  TowSession session;
  for (const auto& procedure : procedures::tow_procedures()) {
    if (sources.is_wanted(procedure->id())) {
      run_one(*procedure, setup, sources, options, session);
    }
  }
  identify::write_estimates(out / "estimates.json", session.shown.estimates);
  harness::write_atomically(out / "report.html",
                            procedures::study_page("Tow experiments on " + setup.rig.name,
                                                   session.shown, session.recoveries));
  if (options.run.json) {
    fmt::print("{}\n", identify::to_json(session.shown.estimates).dump(2));
  } else {
    fmt::print("{}\n", (out / "report.html").string());
  }
  return session.code;
}

}  // namespace

void add_tow(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<TowOptions>();
  options->run.out = "tows";
  auto* verb = app.add_subcommand("tow", "the tow experiments of chapter 8, judged");
  verb->add_option("rig", options->rig, "machine; fixtures/rigs/tow-dry.toml if not given")
      ->check(CLI::ExistingFile);
  verb->add_option("--only", options->only, "this experiment only (EXP-1); may be repeated");
  verb->add_option("--settings", options->settings, "folder of the experiments' own files")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--data", options->data,
                   "evaluate the tows that this folder's tows.toml lists; nothing is emulated")
      ->check(CLI::ExistingDirectory);
  verb->add_flag("--no-runs", options->no_runs, "keep no run folders: every tow in memory alone");
  verb->add_option("--drawn", options->drawn, "so many machines, the first the rig, the rest drawn")
      ->check(CLI::Range(1, 1000));
  verb->add_option("--seeds", options->seeds, "with --drawn: seeds of each")
      ->check(harness::whole_number())
      ->check(CLI::Range(1, 10000));
  verb->add_option("--workers", options->workers, "with --drawn: processes at once")
      ->check(harness::whole_number())
      ->check(CLI::Range(1, 256));
  harness::add_experiment_options(*verb, options->run);
  verb->get_option("--controller")
      ->description(std::string("controller file, or ") + harness::kControllerHelp);
  verb->footer(
      "Example: towbench tow --only EXP-1 --out tows\n"
      "         towbench tow --data tows --out again\n"
      "         towbench tow --drawn 3 --seeds 40 --workers 2 --out set   (continues)\n"
      "The loads are those of fixtures/rigs/tow-*.toml, hung below the machine of the rig given.\n"
      "Writes estimates.json, report.html, and tows.toml with a run folder for each tow; with\n"
      "--drawn set.md, the coverage of the intervals. Exit: 0 all recovered, 1 an estimate misses\n"
      "the emulated water by more than its demand allows or is too unsure, or intervals cover too\n"
      "seldom or too often, 2 bad arguments, 4 an experiment was refused or its data are no good.\n"
      "Recorded tows are judged by nobody. Guide: docs/guide/tow.md");
  verb->callback([options, &exit_code] { exit_code = execute_tow(*options); });
}

}  // namespace towbench::study
