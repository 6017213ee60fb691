// The options that verbs which run experiments share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "harness/run/run_carrier.h"

namespace towbench::harness {

struct ExperimentOptions {
  std::string out = "runs";
  std::optional<std::uint64_t> seed;
  std::string carrier;        // empty: in-process, or local for the real clock
  std::string lines;          // "CONTROLLER,PLANT"; empty: lines are messages
  std::string encoder_lines;  // the same of the encoders
  std::string controller;     // firmware:, process: or external:; empty: the experiment's own
  std::string console;        // "pty": of the firmware, for a person
  std::string clock = "lockstep";
  bool json = false;
  bool quiet = false;
  bool no_report = false;
  bool no_image = false;
};

// "lockstep" or "real"; empty `carrier` is what the clock needs. Throws FixtureError for a carrier
// that cannot serve the clock, with the load that it would bear.
void choose_clock(const std::string& clock, RunOptions& options);

// "CONTROLLER,PLANT" (line_address.h). Throws FixtureError; after choose_carrier() and
// choose_clock().
void choose_lines(const std::string& text, RunOptions& options);

inline constexpr const char* kLinesHelp =
    "digital lines on real ones, controller's and machine's end: "
    "CHIP[+FIRST][~MILLISECONDS],[sim:]CHIP[+FIRST]";

// "firmware:IMAGE.elf" (the virtual board), "process:COMMAND", "external:ADDRESS". Throws
// FixtureError for another word, for a file that is no such image, and beside another carrier or
// lines; an image beside another clock. Before choose_clock().
void choose_controller(const std::string& text, RunOptions& options);

inline constexpr const char* kControllerHelp =
    "firmware:IMAGE.elf: an unmodified bare-metal image on the virtual AM335x; "
    "process:\"COMMAND {address}\": a program that the bench starts; external:ADDRESS: one that "
    "comes by itself; both for experiments with [[reference]]";

void add_experiment_options(CLI::App& verb, ExperimentOptions& options);

// Runs one experiment as the options say, with a progress line, and writes its report. A report
// that cannot be written is told on stderr and turns a pass into a runtime error.
[[nodiscard]] RunResult run_with_options(const ExperimentFixture& fixture,
                                         const ExperimentOptions& options);

}  // namespace towbench::harness
