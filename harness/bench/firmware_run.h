// An experiment whose controller is an image on the virtual board.
#pragma once

#include <filesystem>

#include "harness/bench/plant_end.h"
#include "harness/bench/script_loop.h"
#include "harness/experiment/experiment_fixture.h"

namespace towbench::harness {

// Refuses what is no image for this board. Throws FixtureError naming the file and why.
void check_firmware(const std::filesystem::path& image);

// Plays the experiment; beside the record of any run writes board.json (what was executed) into
// `folder`. An image that the bench knows (debug_probe.h) gets the experiment's controller
// parameters.
[[nodiscard]] RunOutcome run_firmware(const ExperimentFixture& fixture,
                                      const std::filesystem::path& image,
                                      const std::filesystem::path& folder, PlantEnd& plant,
                                      const LoopWatchers& watchers);

}  // namespace towbench::harness
