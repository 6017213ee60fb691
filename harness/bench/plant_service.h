// The emulator's process: runs a plant for whoever is at the other end of a carrier.
#pragma once

#include "core/result.h"
#include "emulator/plant_node.h"
#include "protocol/carriers/line_port.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/messages.h"

namespace towbench::harness {

// Answers `hello` (carriers/connection.h waited for it) and serves until the controller says Bye
// (success) or is lost; then the drive has been removed and the reason is returned. With `lines`
// the machine's digital lines are those, not messages; their failure counts as the loss of the
// controller.
[[nodiscard]] core::Status serve_plant(emulator::PlantNode& plant, protocol::TurnLink& link,
                                       const protocol::Hello& hello,
                                       protocol::LinePort* lines = nullptr);

}  // namespace towbench::harness
