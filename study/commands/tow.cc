// towbench tow: the tow experiments of chapter 8 on an emulated machine, judged.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "harness/checks/check.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "study/commands/verbs.h"
#include "study/procedures/study_page.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/recovery/tow/tow_recovery.h"

namespace towbench::harness {
namespace {

using procedures::ProcedureOutcome;

struct TowOptions {
  std::string rig;
  std::string controller;
  std::vector<std::string> only;
  std::string settings;
  std::string out = "tows";
  std::uint64_t seed = 1;
  bool quiet = false;
  bool json = false;
};

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
  const auto place = r.estimate.at ? fmt::format(" @{:.3g}", *r.estimate.at) : "";
  fmt::print("  {:<40}{:>11.5g} [{:.5g}, {:.5g}]  expected {:.5g}, {:+.2f} % (of {} %){}{}\n",
             r.estimate.quantity + place, r.estimate.value, r.estimate.low, r.estimate.high,
             r.truth, r.error_pct, r.tolerance_pct, r.agrees ? "" : " MISSED",
             r.narrow ? "" : " TOO WIDE");
}

void show_tow_progress(const std::string& what, double share, bool wanted) {
  if (wanted && isatty(STDERR_FILENO) == 1) {
    std::fprintf(stderr, "\r%s: %.0f %%\033[K", what.c_str(), 100 * share);
    std::fflush(stderr);
  }
}

bool is_wanted(std::string_view id, const std::vector<std::string>& only) {
  bool wanted = only.empty();
  for (const auto& each : only) {
    wanted = wanted || each == id;
  }
  return wanted;
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
      throw FixtureError({.file = "--only"}, id, ids);
    }
  }
}

int code_of(const procedures::TowOutcome& outcome, const std::vector<Recovery>& judged) {
  if (outcome.status != ProcedureOutcome::Status::kDone) {
    return kExitInvalid;
  }
  for (const auto& each : judged) {
    if (!each.agrees || !each.narrow) {
      return kExitFail;
    }
  }
  return kExitPass;
}

int execute_tow(const TowOptions& options) {
  const auto fixtures = fixtures_directory();
  const auto named = [&](const std::string& given, const char* folder, const char* standard) {
    return given.empty() ? fixtures / folder / standard : std::filesystem::path(given);
  };
  refuse_unknown(options.only);
  SourceFiles sources;
  const auto rig = load_rig(named(options.rig, "rigs", "tow-dry.toml"), sources);
  const auto controller =
      load_controller(named(options.controller, "controllers", "bbmc-tuned.toml"), sources);
  const procedures::TowLoads loads(rig, controller, options.seed, fixtures / "rigs",
                                   {.stop = &stop_requested(), .progress = {}});
  std::filesystem::create_directories(options.out);
  int code = kExitPass;
  procedures::ChainResult shown;
  std::vector<Recovery> recoveries;
  for (const auto& procedure : procedures::tow_procedures()) {
    const std::string id(procedure->id());
    if (!is_wanted(id, options.only)) {
      continue;
    }
    auto settings = named(options.settings, "tow", "") / (id + ".toml");
    if (!std::filesystem::exists(settings)) {
      settings.clear();
    }
    const auto start = std::chrono::steady_clock::now();
    auto outcome =
        procedure->run({.loads = loads, .settings = settings, .progress = [&](double share) {
                          show_tow_progress(id, share, !options.quiet);
                        }});
    const double wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    // Only now may anybody look at what is in the water.
    const auto judged = judge_tow(loads.truth(procedure->load()), outcome);
    code = std::max(code, code_of(outcome, judged));
    for (auto& each : outcome.estimates) {
      each.procedure = id;
    }
    if (!options.quiet && !options.json) {
      show_tow_progress("", 0, false);
      tell(id, std::string(procedure->title()), outcome, wall_s);
      for (const auto& each : judged) {
        tell(each);
      }
    }
    recoveries.insert(recoveries.end(), judged.begin(), judged.end());
    shown.estimates.insert(shown.estimates.end(), outcome.estimates.begin(),
                           outcome.estimates.end());
    shown.steps.push_back(
        {id, std::string(procedure->title()), core::Axis::kY, std::move(outcome), false, wall_s});
  }
  const std::filesystem::path out = options.out;
  identify::write_estimates(out / "estimates.json", shown.estimates);
  write_atomically(out / "report.html",
                   procedures::study_page("Tow experiments on " + rig.name, shown, recoveries));
  if (options.json) {
    fmt::print("{}\n", identify::to_json(shown.estimates).dump(2));
  } else {
    fmt::print("{}\n", (out / "report.html").string());
  }
  return code;
}

}  // namespace

void add_tow(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<TowOptions>();
  auto* verb = app.add_subcommand("tow", "the tow experiments of chapter 8, judged");
  verb->add_option("rig", options->rig, "machine; fixtures/rigs/tow-dry.toml if not given")
      ->check(CLI::ExistingFile);
  verb->add_option("--only", options->only, "this experiment only (EXP-1); may be repeated");
  verb->add_option("--controller", options->controller, "controller file")
      ->check(CLI::ExistingFile);
  verb->add_option("--settings", options->settings, "folder of the experiments' own files")
      ->check(CLI::ExistingDirectory);
  verb->add_option("--seed", options->seed, "of the sensors' noise and of where things stand")
      ->check(whole_number())
      ->check(whole_number());
  verb->add_option("--out", options->out, "folder to write to")
      ->check(folder_to_write())
      ->check(folder_to_write());
  verb->add_flag("--quiet", options->quiet, "no progress, no tables");
  verb->add_flag("--json", options->json, "print estimates.json");
  verb->footer(
      "Example: towbench tow --only EXP-1 --out tows\n"
      "The loads are those of fixtures/rigs/tow-*.toml, hung below the machine of the rig given.\n"
      "Writes estimates.json, report.html. Exit: 0 all recovered, 1 an estimate misses the\n"
      "emulated water by more than its demand allows or is too unsure, 2 bad arguments, 4 an\n"
      "experiment was refused or its data are no good.");
  verb->callback([options, &exit_code] { exit_code = execute_tow(*options); });
}

}  // namespace towbench::harness
