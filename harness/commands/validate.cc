// towbench validate: reads fixtures as a run would and says what is wrong with them.
#include "harness/commands/validate.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <toml++/toml.h>

#include "harness/campaign/campaign.h"
#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/commands/machine_defaults.h"
#include "harness/commands/sibling.h"
#include "harness/experiment/board_wiring_text.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/fixtures/linux_devices_fixture.h"
#include "harness/realtime/realtime_budget.h"

namespace towbench::harness {
namespace {

// The kind of a fixture follows from the keys that only it may have.
void read_by_kind(const std::filesystem::path& path, MachineDefaults& defaults) {
  SourceFiles sources;
  const auto file = FixtureFile::load(path);
  const auto& table = file.table();
  const auto folder = path.parent_path().filename();
  if (folder == "campaigns" || table.contains("base")) {
    (void)read_campaign(path);
  } else if (folder == "wirings") {
    (void)read_board_wiring(file);
  } else if (folder == "budgets") {
    (void)read_realtime_budget(file);
  } else if (folder == "devices") {
    (void)load_linux_devices(path);
  } else if (table.contains("rig") || table.contains("console") || table.contains("budget")) {
    defaults.of_experiment(load_experiment(path));
  } else if (table.contains("fault")) {
    (void)read_fault_plan(file);
  } else if (table.contains("plants")) {
    defaults.of_rig(path);
  } else if (table.contains("control_rate_Hz") || table.contains("safety") ||
             folder == "controllers") {
    (void)load_controller(path, sources);
  } else {
    defaults.of_plant(path);
  }
}

// Only the study can read everything.
int execute_validate(const std::vector<std::string>& named) {
  const auto paths = fixtures_named(named);
  if (std::none_of(paths.begin(), paths.end(), holds_settings)) {
    return validate_each(paths, {});
  }
  return hand_over("towbench-study", "validate", named);
}

}  // namespace

bool holds_settings(const std::filesystem::path& path) {
  const auto folder = path.parent_path().filename();
  try {
    const auto file = FixtureFile::load(path);
    return file.table().contains("settings") ||
           ((folder == "identification" || folder == "tow") && !file.table().contains("rig"));
  } catch (const FixtureError&) {
    return false;  // whoever reads it says so
  }
}

std::vector<std::filesystem::path> fixtures_named(const std::vector<std::string>& named) {
  std::vector<std::filesystem::path> paths;
  paths.reserve(named.size());
  for (const auto& name : named) {
    paths.push_back(find_experiment(name));
  }
  if (paths.empty()) {
    for (const auto& folder : std::filesystem::directory_iterator(fixtures_directory())) {
      if (folder.is_directory()) {
        const auto files = toml_files_in(folder.path());
        paths.insert(paths.end(), files.begin(), files.end());
      }
    }
    for (const auto& machine : named_machines()) {
      const auto files = toml_files_in(machine.path);
      paths.insert(paths.end(), files.begin(), files.end());
    }
    std::sort(paths.begin(), paths.end());
  }
  return paths;
}

int validate_each(const std::vector<std::filesystem::path>& paths,
                  const ReadFixture& read_settings) {
  int exit_code = kExitPass;
  MachineDefaults defaults;
  for (const auto& path : paths) {
    try {
      if (read_settings && holds_settings(path)) {
        read_settings(path);
      } else {
        read_by_kind(path, defaults);
      }
      std::printf("ok  %s\n", path.c_str());
    } catch (const FixtureError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      exit_code = kExitBadInput;
    }
  }
  defaults.print();
  return exit_code;
}

void add_validate_verb(CLI::App& app, int& exit_code,
                       std::function<int(const std::vector<std::string>&)> execute) {
  auto files = std::make_shared<std::vector<std::string>>();
  auto* verb = app.add_subcommand("validate", "check fixtures without running anything");
  verb->add_option("file", *files, "fixtures; all of the project's when none is named");
  verb->footer("Example: towbench validate my-plant.toml");
  verb->callback(
      [files, &exit_code, execute = std::move(execute)] { exit_code = execute(*files); });
}

void add_validate(CLI::App& app, int& exit_code) {
  add_validate_verb(app, exit_code, execute_validate);
}

}  // namespace towbench::harness
