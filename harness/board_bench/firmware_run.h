// An experiment whose controller is an image on the virtual board.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/board_bench/firmware_bench.h"
#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/lockstep/script_loop.h"

namespace towbench::harness {

// Refuses what is no image for this board. Throws FixtureError naming the file and why.
void check_firmware(const std::filesystem::path& image);

struct FirmwareOptions {
  std::filesystem::path image;
  // The experiment's console is left out: somebody types at a terminal (watchers.terminal), and the
  // run goes no faster than the wall clock.
  bool person_at_console = false;
};

// Plays the experiment; beside the record of any run writes board.json (what was executed) into
// `folder`. An image that the bench knows (debug_probe.h) gets the experiment's controller
// parameters. `checks` takes the verdicts on the board's own faults and budgets.
[[nodiscard]] RunOutcome run_firmware(const ExperimentFixture& fixture,
                                      const FirmwareOptions& options,
                                      const std::filesystem::path& folder,
                                      const FirmwareMachine& machine, const LoopWatchers& watchers,
                                      std::vector<Check>& checks);

}  // namespace towbench::harness
