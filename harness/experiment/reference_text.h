// [[reference]] of an experiment file, read and written.
#pragma once

#include <string>
#include <vector>

#include "emulator/rig_parameters.h"
#include "harness/experiment/reference.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Every [[reference]], in order of time. Throws FixtureError for one that lacks what its kind
// needs, and where two motions of an axis overlap. Tables are left unread.
[[nodiscard]] std::vector<ReferenceMotion> read_reference(TableReader& experiment);
// Refuses a way of an axis that turns, and an angle of one that does not. Throws FixtureError.
void check_units(TableReader& experiment, const std::vector<ReferenceMotion>& motions,
                 const emulator::RigAxes& axes);
// The files of its tables, each added to `sources`. Throws FixtureError.
void read_reference_tables(TableReader& experiment, std::vector<ReferenceMotion>& motions,
                           SourceFiles& sources);
[[nodiscard]] std::string to_toml(const ReferenceMotion& motion);

}  // namespace towbench::harness
