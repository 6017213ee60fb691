// --encoder-lines of the verbs that run experiments.
#pragma once

#include <string>

#include "harness/run/experiment_run.h"

namespace towbench::harness {

inline constexpr const char* kEncoderLinesHelp =
    "encoder channels on real lines, controller's and machine's end: "
    "CHIP[+FIRST][:index][@EDGES/S],[sim:]CHIP[+FIRST][:index]";

// "CONTROLLER,PLANT" (encoder_address.h). Throws FixtureError; after choose_carrier() and
// choose_clock().
void choose_encoder_lines(const std::string& text, RunOptions& options);

// Throws FixtureError when the experiment is faster than the lines carry, with both figures
// (run/encoder_rate.h). By the wall clock the lines are measured for that, a moment before the
// run.
void check_encoder_lines(const ExperimentFixture& fixture, const RunOptions& options);

}  // namespace towbench::harness
