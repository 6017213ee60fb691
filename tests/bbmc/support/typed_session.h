// A person at the console of the whole machine: the controller as every binary links it
// (ControllerNode), in lockstep with the emulated plant.
#pragma once

#include <string>

namespace towbench::tests {

// The session that docs/guide/console-session.md shows: what was typed and what came back, line by
// line.
[[nodiscard]] std::string typed_session();

}  // namespace towbench::tests
