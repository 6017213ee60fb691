#include "harness/bench/plant_service.h"

#include <memory>

#include "protocol/carriers/lockstep_link.h"

namespace towbench::harness {

core::Status serve_plant(emulator::PlantNode& plant, protocol::ByteStream& stream,
                         core::Nanoseconds silence_limit_ns) {
  // On the heap: the link holds its buffers.
  const auto link = std::make_unique<protocol::LockstepLink>(stream, silence_limit_ns);
  plant.connect(link->peer());
  while (!plant.finished()) {
    if (const auto turn = link->wait(plant); !turn) {
      plant.peer_lost(turn.error());
      return core::failure(turn.error());
    }
  }
  return {};
}

}  // namespace towbench::harness
