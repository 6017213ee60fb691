// [start] of an experiment file, read and written: where each axis stands at time 0.
#pragma once

#include <string>

#include "harness/fixtures/rig_fixture.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Places the rig's axes, and hashes it anew. Throws FixtureError for a place beyond the hard ends,
// of an axis that is not there, or in a unit that does not fit it.
void read_start(TableReader& experiment, RigFixture& rig);
[[nodiscard]] std::string start_toml(const emulator::RigParameters& rig);

}  // namespace towbench::harness
