// The emulator's process: runs a plant for whoever is at the other end of a carrier.
#pragma once

#include "core/result.h"
#include "emulator/plant_node.h"
#include "harness/link/wires.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/messages.h"

namespace towbench::harness {

// Answers `hello` (carriers/connection.h waited for it) and serves until the controller says Bye
// (success) or is lost; then the drive has been removed and the reason is returned. What has real
// lines of its own is no message; a failure of theirs counts as the loss of the controller. A
// message of an unknown kind or with a field out of range is answered by a Fault. `witness` hears
// the controller before the plant does.
[[nodiscard]] core::Status serve_plant(emulator::PlantNode& plant, protocol::TurnLink& link,
                                       const protocol::Hello& hello, const PlantWires& wires = {},
                                       protocol::MessageSink* witness = nullptr);

}  // namespace towbench::harness
