// The emulator's process: runs a plant for whoever is at the other end of a byte stream.
#pragma once

#include "core/result.h"
#include "emulator/plant_node.h"
#include "protocol/byte_stream.h"

namespace towbench::harness {

// Serves until the controller says Bye (success) or is lost; then the drive has been removed and
// the reason is returned. `silence_limit_ns` is host time.
[[nodiscard]] core::Status serve_plant(emulator::PlantNode& plant, protocol::ByteStream& stream,
                                       core::Nanoseconds silence_limit_ns);

}  // namespace towbench::harness
