#include "harness/link/plant_service.h"

namespace towbench::harness {

core::Status serve_plant(emulator::PlantNode& plant, protocol::TurnLink& link,
                         const protocol::Hello& hello, const PlantWires& wires) {
  WiredPath path(plant, plant, link.peer(), wires, EdgeTimes::kOfExchange);
  plant.connect(path.from_plant());
  path.from_controller().on(hello);
  while (!plant.finished()) {
    const auto turn = link.wait(path.from_controller());
    const auto lines = path.status();
    const auto lost = !turn ? turn.error() : !lines ? lines.error() : core::ErrorCode::kNone;
    if (lost != core::ErrorCode::kNone) {
      plant.peer_lost(lost);
      return core::failure(lost);
    }
  }
  return {};
}

}  // namespace towbench::harness
