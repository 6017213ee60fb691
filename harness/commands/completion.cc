// towbench completion: what bash needs to complete verbs, options and experiments, from the command
// line's own description, so that the two cannot differ.
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/fixtures/fixture_paths.h"

namespace towbench::harness {
namespace {

std::string long_options_of(const CLI::App& verb) {
  std::string words;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      words += fmt::format(" --{}", name);
    }
  }
  return words;
}

std::string experiment_names() {
  std::string words;
  for (const auto& experiment : named_experiments()) {
    words += " " + experiment.name;
  }
  return words;
}

bool takes_experiments(const std::string& verb) {
  return verb == "run" || verb == "falsify";
}

std::string bash_script(const CLI::App& app) {
  std::string verbs;
  std::string cases;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    verbs += " " + verb->get_name();
    cases += fmt::format("    {}) words='{}{}' ;;\n", verb->get_name(), long_options_of(*verb),
                         takes_experiments(verb->get_name()) ? experiment_names() : "");
  }
  return fmt::format(
      "_towbench() {{\n"
      "  local words verb=${{COMP_WORDS[1]}} current=${{COMP_WORDS[COMP_CWORD]}}\n"
      "  ((COMP_CWORD == 1)) && verb=\n"
      "  case $verb in\n"
      "    '') words='{} test --help --version' ;;\n{}"
      "    test) words='--quick --only --list --help' ;;\n"
      "  esac\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
      "}}\n"
      "complete -o default -F _towbench towbench ./towbench\n",
      verbs, cases);
}

}  // namespace

void add_completion(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("completion", "print the script with which bash completes");
  verb->footer("Example: towbench completion >~/.local/share/bash-completion/completions/towbench");
  verb->callback([&app, &exit_code] {
    std::fputs(bash_script(app).c_str(), stdout);
    exit_code = kExitPass;
  });
}

}  // namespace towbench::harness
