#include "harness/link/plant_service.h"

#include "protocol/tee_sink.h"

namespace towbench::harness {
namespace {

// Tells the controller what the link could read and not take.
class UntakenMessages {
 public:
  explicit UntakenMessages(const protocol::TurnLink& link) noexcept : link_(link) {}

  void answer(core::Nanoseconds now_ns, protocol::MessageSink& controller) noexcept {
    const auto& counts = link_.counts();
    if (counts.bad_field > bad_field_) {
      controller.on(fault(core::ErrorCode::kMessageBadField, now_ns, counts.bad_field));
    }
    if (counts.unknown > unknown_) {
      controller.on(fault(core::ErrorCode::kMessageUnknown, now_ns, counts.unknown));
    }
    bad_field_ = counts.bad_field;
    unknown_ = counts.unknown;
  }

 private:
  static protocol::Fault fault(core::ErrorCode code, core::Nanoseconds now_ns,
                               std::uint64_t count) noexcept {
    return {.code = code, .time_ns = now_ns, .detail = static_cast<std::uint32_t>(count)};
  }

  const protocol::TurnLink& link_;
  std::uint64_t bad_field_ = 0;
  std::uint64_t unknown_ = 0;
};

}  // namespace

core::Status serve_plant(emulator::PlantNode& plant, protocol::TurnLink& link,
                         const protocol::Hello& hello, const PlantWires& wires,
                         protocol::MessageSink* witness) {
  protocol::MessageSink nobody;
  protocol::TeeSink witnessed(witness != nullptr ? *witness : nobody, plant);
  WiredPath path(plant, witnessed, link.peer(), wires, EdgeTimes::kOfExchange);
  UntakenMessages untaken(link);
  plant.connect(path.from_plant());
  path.from_controller().on(hello);
  while (!plant.finished()) {
    const auto turn = link.wait(path.from_controller());
    untaken.answer(plant.now_ns(), path.from_plant());
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
