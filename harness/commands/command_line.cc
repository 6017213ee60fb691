#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "harness/commands/command.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/judge/check.h"

namespace towbench::harness {
namespace {

int parse_and_run(int argc, char** argv) {
  CLI::App app{
      "towbench: a hardware-in-the-loop bench for the two-axis tow-tank carriage.\n"
      "The unmodified BBMC controller runs against an emulated machine; every run is judged.",
      "towbench"};
  app.set_version_flag("--version", TOWBENCH_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 pass, 1 a budget failed, 2 bad arguments or fixture, 3 runtime error,\n"
      "4 INVALID (the run proves nothing), 99 skipped.\n\nExample: towbench demo");
  int exit_code = kExitRuntime;
  for (const auto add : {add_demo, add_run, add_list, add_validate, add_emulate, add_control,
                         add_replay, add_report}) {
    add(app, exit_code);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitPass : kExitBadInput;
  }
  return exit_code;
}

}  // namespace

int run_command_line(int argc, char** argv) noexcept {
  try {
    return parse_and_run(argc, argv);
  } catch (const FixtureError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "towbench: %s\n", error.what());
    return kExitRuntime;
  }
}

}  // namespace towbench::harness
