// BBMC and the virtual board are those of the tow tank; on another machine a run says so, once.
#pragma once

#include <string>

#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {

// One line; empty where every axis has the tank's kind of transmission.
[[nodiscard]] std::string tank_controller_note(const RigFixture& rig);

// One line on home switches and holding brakes, which neither BBMC nor an image has a pin for;
// empty where the rig has none.
[[nodiscard]] std::string unserved_parts_note(const RigFixture& rig);

// Both on the error output, the first of BBMC alone.
void tell_notes(const RigFixture& rig, bool is_bbmc);

}  // namespace towbench::harness
