// BBMC is the tow tank's controller; on another machine a run says so, once.
#pragma once

#include <string>

#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {

// One line; empty where every axis is driven by a transmission, as the tank's are.
[[nodiscard]] std::string tank_controller_note(const RigFixture& rig);

}  // namespace towbench::harness
