// A wiring file: which pins of the virtual board an image uses for what.
#pragma once

#include "harness/experiment/board_wiring.h"
#include "harness/fixtures/fixture_file.h"

namespace towbench::harness {

// What the file does not name is as BoardWiring has it. Throws FixtureError for a pin that there is
// not, and for one that is used twice.
[[nodiscard]] BoardWiring read_board_wiring(const FixtureFile& file);

}  // namespace towbench::harness
