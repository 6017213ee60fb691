// Verbs of the sibling program `towbench-study`, which needs libraries that a first demo should not
// wait for: named here, carried out there.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "harness/commands/command.h"
#include "harness/judge/check.h"

namespace towbench::harness {
namespace {

// Returns only when the sibling cannot be started.
int hand_over(const std::string& verb, const std::vector<std::string>& rest) {
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "towbench-study";
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

}  // namespace

void add_identify_elsewhere(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("identify", "find a machine's parameters by experiments on it");
  verb->prefix_command();
  verb->set_help_flag();  // --help is the sibling's to answer
  verb->callback([verb, &exit_code] { exit_code = hand_over("identify", verb->remaining()); });
}

}  // namespace towbench::harness
