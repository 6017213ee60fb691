// towbench report: writes report.html of run folders anew.
#include "harness/report/report.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/option_checks.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string combined;
};

int tell(const ReportResult& written) {
  if (!written) {
    std::fprintf(stderr, "towbench: no report: %s\n", written.error().c_str());
    return kExitRuntime;
  }
  for (const auto& sentence : written->contradictions) {
    std::fprintf(stderr, "towbench: %s\n", sentence.c_str());
  }
  std::printf("%s\n", written->page.c_str());
  return written->contradictions.empty() ? kExitPass : kExitInvalid;
}

// Anywhere else a page would be written where nobody wants one.
bool is_run_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* file : {"result.json", "log.csv", "truth.csv", "events.jsonl"}) {
    if (std::filesystem::exists(std::filesystem::symlink_status(folder / file, ignored))) {
      return true;
    }
  }
  return false;
}

int execute_report(const ReportOptions& options) {
  if (!options.combined.empty()) {
    const std::vector<std::filesystem::path> folders(options.folders.begin(),
                                                     options.folders.end());
    return tell(write_combined_report(folders, options.combined));
  }
  int exit_code = kExitPass;
  for (const auto& folder : options.folders) {
    if (!is_run_folder(folder)) {
      throw FixtureError({folder}, "a folder without a run's files", "a run folder");
    }
    exit_code = graver(exit_code, tell(write_report(folder)));
  }
  return exit_code;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  auto* verb = app.add_subcommand("report", "write the report of a run folder again");
  verb->add_option("folder", options->folders, "run folders")
      ->check(CLI::ExistingDirectory)
      ->check(CLI::ExistingDirectory)
      ->required();
  verb->add_option("--combined", options->combined, "one page about all of them, written to FILE");
  verb->footer("Example: towbench report runs/20250131T120000Z-circle-1a2b3c4d");
  verb->callback([options, &exit_code] { exit_code = execute_report(*options); });
}

}  // namespace towbench::harness
