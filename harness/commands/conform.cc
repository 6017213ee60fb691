// towbench conform: does a controller keep the protocol's duties.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/commands/command.h"
#include "harness/commands/experiment_options.h"
#include "harness/external/conformance.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {
namespace {

struct ConformOptions {
  std::string controller;
  std::string rig;
  std::string only;
  std::string printed = "/dev/null";
  bool json = false;
};

std::string command_of(const std::string& text) {
  RunOptions options;
  choose_controller(text, options);
  if (!options.external || options.external->address) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + text + '"',
                       "process:COMMAND: it is started again for every duty");
  }
  return options.external->command;
}

void print(const std::vector<Check>& checks) {
  for (const auto& check : checks) {
    fmt::print("{:<8} {:<7} {:<21} {}{}\n", name_of(check.verdict), check.source, check.name,
               check.meaning, check.reason.empty() ? "" : ": " + check.reason);
  }
}

void print_json(const std::vector<Check>& checks) {
  auto lines = nlohmann::json::array();
  for (const auto& check : checks) {
    lines.push_back({{"name", check.name},
                     {"requirement", check.source},
                     {"meaning", check.meaning},
                     {"verdict", name_of(check.verdict)},
                     {"reason", check.reason}});
  }
  fmt::print("{}\n", lines.dump(2));
}

int execute_conform(const ConformOptions& options) {
  const auto command = command_of(options.controller);
  SourceFiles sources;
  const auto nominal = fixtures_directory() / "rigs" / "macs-nominal.toml";
  const auto rig =
      load_rig(options.rig.empty() ? nominal : std::filesystem::path(options.rig), sources);
  const auto checks = check_conformance(command, rig.parameters, options.printed, options.only);
  if (checks.empty()) {
    throw FixtureError({"command line", 0, "--only"}, '"' + options.only + '"',
                       "a duty of that machine: it has no absolute encoder");
  }
  options.json ? print_json(checks) : print(checks);
  return exit_code_of(worst_of(checks));
}

}  // namespace

void add_conform(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ConformOptions>();
  auto* verb = app.add_subcommand("conform", "does a controller keep the duties of the protocol");
  verb->add_option("--controller", options->controller,
                   "process:\"COMMAND {address}\": a program that is started for every duty")
      ->required();
  verb->add_option("--rig", options->rig,
                   "a rig file; fixtures/rigs/macs-nominal.toml when absent");
  verb->add_option("--only", options->only, "one duty")->check(CLI::IsMember(conformance_duties()));
  verb->add_option("--printed", options->printed, "file that what it prints is appended to")
      ->capture_default_str();
  verb->add_flag("--json", options->json, "print the findings as JSON");
  verb->footer("Example: towbench conform --controller 'process:python3 pid.py {address}'");
  verb->callback([options, &exit_code] { exit_code = execute_conform(*options); });
}

}  // namespace towbench::harness
