// The plant in the same process and thread: a message is a call, and when it returns the answer has
// been heard.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "emulator/plant_node.h"
#include "harness/bench/peer_control.h"
#include "harness/bench/plant_end.h"
#include "harness/bench/unrecorded_plant.h"

namespace towbench::harness {

class InProcessPlant final : public PlantEnd, public PeerControl {
 public:
  // The observer outlives this.
  InProcessPlant(const emulator::RigParameters& rig, std::uint64_t seed,
                 std::span<const emulator::ScheduledEvent> events,
                 emulator::PlantObserver& observer)
      : rig_(rig), seed_(seed) {
    node_.emplace(rig, seed, events, observer);
  }

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return *node_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    controller_ = &controller;
    node_->connect(controller);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn /*expected*/) noexcept override { return {}; }
  [[nodiscard]] bool happen(const emulator::ScheduledEvent& event) override {
    node_->add_event(event);
    return true;
  }

  // As a socket whose other end is closed.
  [[nodiscard]] core::ErrorCode kill_peer() noexcept override {
    return core::ErrorCode::kPeerClosed;
  }
  // The new one was greeted by nobody: it refuses what it is told.
  [[nodiscard]] core::ErrorCode restart_peer() noexcept override {
    node_.emplace(rig_, seed_, std::span<const emulator::ScheduledEvent>{}, unrecorded_);
    node_->connect(*controller_);
    return core::ErrorCode::kNone;
  }
  // As the driver of a node that is off the bus.
  [[nodiscard]] core::ErrorCode leave_bus() noexcept override {
    return core::ErrorCode::kTransportFailed;
  }

 private:
  emulator::RigParameters rig_;
  std::uint64_t seed_;
  UnrecordedPlant unrecorded_;
  protocol::MessageSink* controller_ = nullptr;
  std::optional<emulator::PlantNode> node_;
};

}  // namespace towbench::harness
