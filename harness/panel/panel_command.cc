// towbench panel: watching and steering a run in the browser.
#include "harness/panel/panel_command.h"

#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/panel/panel_assets.h"
#include "harness/panel/session.h"
#include "harness/panel/web_server.h"

namespace towbench::harness {
namespace {

struct PanelOptions {
  std::string out = "runs";
  std::string controller;
  WebOptions web;
};

// A page names no command: who follows a reference is said here, by whoever starts the panel.
std::optional<ExternalController> controller_of(const PanelOptions& options) {
  RunOptions chosen;
  choose_controller(options.controller, chosen);
  if (!options.controller.empty() && !chosen.external) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + options.controller + '"',
                       "process:COMMAND or external:ADDRESS; an image runs by `run`");
  }
  return chosen.external;
}

int execute_panel(const PanelOptions& options) {
  if (panel::script_asset().text.empty()) {
    throw FixtureError({.file = "panel"}, "a build without the page's script",
                       "one with TOWBENCH_REPORT_ASSETS=ON");
  }
  const auto& stop = stop_requested();
  Session session(options.out, controller_of(options));
  WebServer server(options.web, session);
  const auto tell = [](const std::string& address) {
    std::printf("%s\n", address.c_str());
    std::fflush(stdout);
  };
  server.on_ticket_used([&](const std::string& address) {
    std::puts("let in; the next browser's address:");
    tell(address);
  });
  std::puts("towbench panel; open this address in a browser on this machine (Ctrl-C ends it):");
  tell(server.address_with_ticket());
  server.run(stop);
  return kExitPass;
}

}  // namespace

void add_panel(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PanelOptions>();
  auto* verb = app.add_subcommand("panel", "watch and steer runs in the browser");
  verb->add_option("--out", options->out, "folder of the run folders, its own and older ones")
      ->check(folder_to_write())
      ->check(folder_to_write())
      ->capture_default_str();
  verb->add_option("--controller", options->controller,
                   "who follows the experiments with [[reference]]: process:\"COMMAND {address}\" "
                   "or external:ADDRESS");
  verb->add_option("--port", options->web.port, "TCP port; 0: any that is free")
      ->check(whole_number())
      ->check(whole_number())
      ->capture_default_str();
  verb->add_option("--listen", options->web.address,
                   "address to listen on; another than this machine's own lets others steer")
      ->check(CLI::ValidIPV4)
      ->capture_default_str();
  verb->footer("Example: towbench panel --port 8080");
  verb->callback([options, &exit_code] { exit_code = execute_panel(*options); });
}

}  // namespace towbench::harness
