// towbench demo: the four experiments that show what the bench does, one table, one report.
#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/commands/command.h"
#include "harness/commands/encoder_option.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/verdict_table.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/run_folder.h"
#include "harness/report/report.h"

namespace towbench::harness {
namespace {

constexpr std::array kDemo{"trapezoid-400", "circle", "pulses", "endstop-y-max"};

struct DemoOptions {
  ExperimentOptions shared;
  bool board = false;
};

// Built beside the bench by ./towbench when it is asked for.
std::string bare_metal_image() {
  const auto program = std::filesystem::canonical("/proc/self/exe");
  const auto image = program.parent_path().parent_path() / "baremetal" / "bbmc.elf";
  if (!std::filesystem::exists(image)) {
    throw FixtureError({"command line", 0, "--board"}, image.string() + " is not there",
                       "the bare-metal image, which `./towbench demo --board` builds");
  }
  return "firmware:" + image.string();
}

int execute_demo(const ExperimentOptions& options) {
  std::vector<ExperimentFixture> fixtures;
  fixtures.reserve(kDemo.size());
  for (const char* name : kDemo) {
    fixtures.push_back(load_experiment(find_experiment(name)));
  }
  int exit_code = kExitPass;
  std::vector<std::filesystem::path> folders;
  for (const auto& fixture : fixtures) {
    const auto run = run_with_options(fixture, options);
    exit_code = graver(exit_code, run.exit_code);
    folders.push_back(run.folder);
    std::fputs(verdict_table(fixture.experiment.name, run, !options.quiet).c_str(), stdout);
    std::fflush(stdout);
    if (!run.complete) {
      break;
    }
  }
  const auto page = std::filesystem::path(options.out) / (utc_now_compact() + "-demo.html");
  const auto written = write_combined_report(folders, page);
  if (!written) {
    std::fprintf(stderr, "towbench: no report: %s\n", written.error().c_str());
    return graver(exit_code, kExitRuntime);
  }
  std::printf("%s\n", written->page.c_str());
  return written->contradictions.empty() ? exit_code : graver(exit_code, kExitInvalid);
}

}  // namespace

void add_demo(CLI::App& app, int& exit_code) {
  auto chosen = std::make_shared<DemoOptions>();
  auto* options = &chosen->shared;
  auto* verb = app.add_subcommand(
      "demo", "trapezoid, circle, open-loop pulses and an end-stop, judged in one report");
  verb->add_option("--out", options->out, "folder below which the run folders are made")
      ->check(folder_to_write())
      ->capture_default_str();
  verb->add_option("--carrier", options->carrier, kCarrierHelp);
  verb->add_option("--lines", options->lines, kLinesHelp);
  verb->add_option("--encoder-lines", options->encoder_lines, kEncoderLinesHelp);
  verb->add_flag("--board", chosen->board,
                 "BBMC as a bare-metal image on the virtual AM335x instead of in this process");
  verb->add_flag("-q,--quiet", options->quiet, "print failures and the report's path only");
  verb->footer("Example: towbench demo");
  verb->callback([chosen, &exit_code] {
    if (chosen->board) {
      chosen->shared.controller = bare_metal_image();
    }
    exit_code = execute_demo(chosen->shared);
  });
}

}  // namespace towbench::harness
