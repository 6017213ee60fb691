#include "harness/bench/plant_service.h"

#include <optional>

#include "harness/bench/real_lines.h"

namespace towbench::harness {

core::Status serve_plant(emulator::PlantNode& plant, protocol::TurnLink& link,
                         const protocol::Hello& hello, protocol::LinePort* lines) {
  std::optional<RealLinesAtPlant> real;
  protocol::MessageSink* to_plant = &plant;
  protocol::MessageSink* to_controller = &link.peer();
  if (lines != nullptr) {
    real.emplace(plant, link.peer(), *lines);
    to_plant = &real->from_controller();
    to_controller = &real->to_controller();
  }
  plant.connect(*to_controller);
  plant.on(hello);
  while (!plant.finished()) {
    const auto turn = link.wait(*to_plant);
    const auto lost = !turn                     ? turn.error()
                      : real && !real->status() ? real->status().error()
                                                : core::ErrorCode::kNone;
    if (lost != core::ErrorCode::kNone) {
      plant.peer_lost(lost);
      return core::failure(lost);
    }
  }
  return {};
}

}  // namespace towbench::harness
