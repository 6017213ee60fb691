// The options that verbs which run experiments share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "harness/bench/experiment_run.h"

namespace towbench::harness {

struct ExperimentOptions {
  std::string out = "runs";
  std::optional<std::uint64_t> seed;
  std::string carrier = "in-process";
  bool json = false;
  bool quiet = false;
  bool no_report = false;
};

void add_experiment_options(CLI::App& verb, ExperimentOptions& options);

// Runs one experiment as the options say, with a progress line, and writes its report. A report
// that cannot be written is told on stderr and turns a pass into a runtime error.
[[nodiscard]] RunResult run_with_options(const ExperimentFixture& fixture,
                                         const ExperimentOptions& options);

}  // namespace towbench::harness
