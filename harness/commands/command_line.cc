#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/commands/exit_codes.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/nearest_key.h"

namespace towbench::harness {
namespace {

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> verbs = {"test"};  // the launcher's own
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    verbs.push_back(verb->get_name());
  }
  return verbs;
}

// CLI11 would say that a verb is missing. False when `word` is one, or an option.
bool refuse_unknown_verb(const std::vector<std::string>& verbs, std::string_view word) {
  if (word.starts_with('-') || std::find(verbs.begin(), verbs.end(), word) != verbs.end()) {
    return false;
  }
  const std::string nearest = nearest_key(word, verbs);
  fmt::print(stderr, "towbench: no verb '{}'{} (allowed: {})\n", word,
             nearest.empty() ? "" : "; did you mean " + nearest + "?", fmt::join(verbs, " "));
  return true;
}

int parse_and_run(std::span<const AddVerb> add_verbs, int argc, char** argv) {
  CLI::App app{
      "towbench: a hardware-in-the-loop bench for motion controllers.\n"
      "BBMC, or a controller of your own, runs unmodified against an emulated machine; every run\n"
      "is judged.",
      "towbench"};
  app.set_version_flag("--version", TOWBENCH_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 pass, 1 a budget failed, 2 bad arguments or fixture, 3 runtime error,\n"
      "4 INVALID (the run proves nothing), 99 skipped.\n\nExample: towbench demo");
  int exit_code = kExitRuntime;
  for (const AddVerb add : add_verbs) {
    add(app, exit_code);
  }
  if (argc > 1 && refuse_unknown_verb(verbs_of(app), argv[1])) {
    return kExitBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitPass : kExitBadInput;
  }
  return exit_code;
}

std::string cut(const std::string& text) {
  constexpr std::size_t kMost = 200;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

// What could not be printed was not told: a result that nobody has is no success.
int finish_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) {
    return kExitPass;
  }
  std::fputs("towbench: standard output cannot be written\n", stderr);
  return kExitRuntime;
}

}  // namespace

int run_command_line(std::span<const AddVerb> verbs, int argc, char** argv) noexcept {
  try {
    const int exit_code = parse_and_run(verbs, argc, argv);
    return graver(exit_code, finish_output());
  } catch (const FixtureError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "towbench: %s: %s\n", cut(error.path1().string()).c_str(),
                 error.code().message().c_str());
    return error.code() == std::errc::filename_too_long ? kExitBadInput : kExitRuntime;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "towbench: %s\n", error.what());
    return kExitRuntime;
  }
}

}  // namespace towbench::harness
