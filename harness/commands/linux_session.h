// A session on kernel devices: the controller drives what the devices file names, by the wall
// clock.
#pragma once

#include <string>

#include "harness/fixtures/controller_fixture.h"

namespace towbench::harness {

// `address` is linux:FILE. `out` is a folder for log.csv and the other records, or empty. Returns
// the exit code: kExitRuntime when a device cannot be had. Throws FixtureError for a wrong file.
[[nodiscard]] int run_on_devices(const std::string& address, const ControllerFixture& controller,
                                 const std::string& out);

}  // namespace towbench::harness
