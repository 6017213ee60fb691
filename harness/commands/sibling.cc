// Verbs of the sibling programs `towbench-study` and `towbench-panel`, which need libraries that a
// first demo should not wait for: named here, carried out there.
#include "harness/commands/sibling.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "harness/checks/check.h"
#include "harness/commands/command.h"

namespace towbench::harness {

int hand_over(const std::string& sibling, const std::string& verb,
              const std::vector<std::string>& rest) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / sibling;
  std::vector<std::string> words{program.string(), verb};
  words.insert(words.end(), rest.begin(), rest.end());
  std::vector<char*> arguments;
  for (auto& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  std::fprintf(stderr, "towbench: %s: %s; `./towbench %s` builds it\n", program.c_str(),
               std::strerror(errno), verb.c_str());
  return kExitRuntime;
}

namespace {

void add_elsewhere(CLI::App& app, int& exit_code, const std::string& name, const char* what,
                   const std::string& sibling = "towbench-study") {
  auto* verb = app.add_subcommand(name, what);
  verb->prefix_command();
  verb->set_help_flag();  // --help is the sibling's to answer
  verb->callback([verb, sibling, name, &exit_code] {
    exit_code = hand_over(sibling, name, verb->remaining());
  });
}

}  // namespace

void add_identify_elsewhere(CLI::App& app, int& exit_code) {
  add_elsewhere(app, exit_code, "identify", "find a machine's parameters by experiments on it");
  add_elsewhere(app, exit_code, "tow", "the tow experiments of chapter 8, judged");
  add_elsewhere(app, exit_code, "results", "the thesis's tables: thesis, bench, truth");
  add_elsewhere(app, exit_code, "diagnose", "name what a model gets wrong, from measured data");
}

void add_panel_elsewhere(CLI::App& app, int& exit_code) {
  add_elsewhere(app, exit_code, "panel", "watch and steer runs in the browser", "towbench-panel");
}

}  // namespace towbench::harness
