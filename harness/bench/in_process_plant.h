// The plant in the same process and thread: a message is a call, and when it returns the answer has
// been heard.
#pragma once

#include <cstdint>
#include <span>

#include "emulator/plant_node.h"
#include "harness/bench/plant_end.h"

namespace towbench::harness {

class InProcessPlant final : public PlantEnd {
 public:
  InProcessPlant(const emulator::RigParameters& rig, std::uint64_t seed,
                 std::span<const emulator::ScheduledEvent> events,
                 emulator::PlantObserver& observer)
      : node_(rig, seed, events, observer) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return node_; }
  void connect(protocol::MessageSink& controller) noexcept override { node_.connect(controller); }
  [[nodiscard]] core::Status wait_for(protocol::Turn /*expected*/) noexcept override { return {}; }
  [[nodiscard]] bool happen(const emulator::ScheduledEvent& event) override {
    node_.add_event(event);
    return true;
  }

 private:
  emulator::PlantNode node_;
};

}  // namespace towbench::harness
