#include "study/commands/tow_sources.h"

#include <algorithm>

#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"
#include "study/runs/kept_runs.h"
#include "study/runs/recorded_runs.h"

namespace towbench::study {

TowSources::TowSources(const TowOptions& options) : options_(options) {
  if (!options.data.empty()) {
    list_ = read_tow_list(options.data);
  }
}

bool TowSources::is_wanted(std::string_view id) const {
  const auto& only = options_.only;
  if (!only.empty() || !list_) {
    return only.empty() || std::find(only.begin(), only.end(), id) != only.end();
  }
  return std::any_of(list_->tows.begin(), list_->tows.end(),
                     [&](const ListedTow& tow) { return tow.experiment == id; });
}

std::unique_ptr<procedures::RunSource> TowSources::of(const std::string& id) {
  if (list_) {
    return std::make_unique<RecordedRuns>(id, *list_);
  }
  if (options_.no_runs) {
    return nullptr;
  }
  auto kept = std::make_unique<KeptRuns>(
      id, options_.run.out,
      [this](const harness::ExperimentFixture& fixture, const std::filesystem::path& below,
             std::uint64_t seed) {
        auto how = options_.run;
        how.out = below.string();
        how.seed = seed;
        how.quiet = true;
        how.json = false;
        how.controller = options_.names_another_controller() ? how.controller : "";
        return harness::run_with_options(fixture, how);
      },
      tows_);
  return kept;
}

void TowSources::write_list() const {
  if (!tows_.empty()) {
    harness::write_atomically(std::filesystem::path(options_.run.out) / kTowListFile,
                              tow_list_toml(tows_));
  }
}

TowSetup setup_of(const TowOptions& options) {
  const std::filesystem::path data = options.data;
  const auto fixtures = harness::fixtures_directory();
  const auto named = [&](const std::string& given, const std::filesystem::path& of_record,
                         const std::filesystem::path& standard) {
    const bool recorded = !data.empty() && std::filesystem::exists(data / of_record);
    return !given.empty() ? std::filesystem::path(given) : recorded ? data / of_record : standard;
  };
  const auto controller = options.names_another_controller() ? "" : options.run.controller;
  harness::SourceFiles sources;
  return {harness::load_rig(
              named(options.rig, "machine/rig.toml", fixtures / "rigs" / "tow-dry.toml"), sources),
          harness::load_controller(named(controller, "machine/controller.toml",
                                         fixtures / "controllers" / "bbmc-tuned.toml"),
                                   sources),
          named(options.settings, "settings", fixtures / "tow")};
}

void refuse_together(const TowOptions& options) {
  const bool how_to_run = !options.run.carrier.empty() || options.run.clock != "lockstep" ||
                          !options.run.lines.empty() || !options.run.encoder_lines.empty() ||
                          options.names_another_controller();
  if (how_to_run && (!options.data.empty() || options.no_runs)) {
    throw harness::FixtureError(
        {"command line", 0, options.no_runs ? "--no-runs" : "--data"},
        "beside a carrier, a clock or another controller",
        options.no_runs ? "tows in memory alone" : "tows that were made before");
  }
  if (options.drawn > 0 && (how_to_run || !options.data.empty())) {
    throw harness::FixtureError({"command line", 0, "--drawn"},
                                "beside a record, a carrier, a clock or another controller",
                                "drawn machines in this process");
  }
  if (!options.run.console.empty()) {
    throw harness::FixtureError({"command line", 0, "--console"}, options.run.console,
                                "none: the tow's script types");
  }
}

void keep_setup(const TowSetup& setup, const std::filesystem::path& settings,
                const std::filesystem::path& out) {
  std::filesystem::create_directories(out / "machine");
  write_machine(setup.rig, setup.controller, out / "machine");
  if (!settings.empty()) {
    std::filesystem::create_directories(out / "settings");
    std::filesystem::copy_file(settings, out / "settings" / settings.filename(),
                               std::filesystem::copy_options::overwrite_existing);
  }
}

}  // namespace towbench::study
