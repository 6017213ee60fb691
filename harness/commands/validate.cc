// towbench validate: reads fixtures as a run would and says what is wrong with them.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <toml++/toml.h>

#include "harness/campaign/campaign.h"
#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/experiment/board_wiring_text.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/fixtures/linux_devices_fixture.h"

namespace towbench::harness {
namespace {

// The kind of a fixture follows from the keys that only it may have.
void read_by_kind(const std::filesystem::path& path) {
  SourceFiles sources;
  const auto file = FixtureFile::load(path);
  const auto& table = file.table();
  const auto folder = path.parent_path().filename();
  if (folder == "campaigns") {
    (void)read_campaign(path);
  } else if (folder == "wirings") {
    (void)read_board_wiring(file);
  } else if (folder == "devices") {
    (void)load_linux_devices(path);
  } else if (table.contains("rig") || table.contains("console") || table.contains("budget")) {
    (void)load_experiment(path);
  } else if (table.contains("fault")) {
    (void)read_fault_plan(file);
  } else if (table.contains("plants")) {
    (void)load_rig(path, sources);
  } else if (table.contains("control_rate_Hz") || table.contains("safety") ||
             folder == "controllers") {
    (void)load_controller(path, sources);
  } else {
    (void)load_plant(path, sources);
  }
}

int execute_validate(const std::vector<std::string>& named) {
  std::vector<std::filesystem::path> paths;
  paths.reserve(named.size());
  for (const auto& name : named) {
    paths.push_back(find_experiment(name));
  }
  if (paths.empty()) {
    for (const char* kind : {"plants", "rigs", "controllers", "devices", "experiments", "motions",
                             "any-controller", "wirings", "faults", "campaigns"}) {
      for (auto& path : toml_files_in(fixtures_directory() / kind)) {
        paths.push_back(std::move(path));
      }
    }
  }
  int exit_code = kExitPass;
  for (const auto& path : paths) {
    try {
      read_by_kind(path);
      std::printf("ok  %s\n", path.c_str());
    } catch (const FixtureError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      exit_code = kExitBadInput;
    }
  }
  return exit_code;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
  auto files = std::make_shared<std::vector<std::string>>();
  auto* verb = app.add_subcommand("validate", "check fixtures without running anything");
  verb->add_option("file", *files, "fixtures; all of the project's when none is named");
  verb->footer("Example: towbench validate my-plant.toml");
  verb->callback([files, &exit_code] { exit_code = execute_validate(*files); });
}

}  // namespace towbench::harness
