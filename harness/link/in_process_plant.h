// The plant in the same process and thread: a message is a call, and when it returns the answer has
// been heard; complaints about commands at the end of the exchange (turn_answers.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "emulator/plant_node.h"
#include "harness/link/peer_control.h"
#include "harness/link/plant_end.h"
#include "harness/link/turn_answers.h"
#include "harness/link/unrecorded_plant.h"
#include "protocol/each_message.h"

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

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return commands_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    answers_.connect(controller);
    node_->connect(answers_);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn /*expected*/) noexcept override {
    answers_.deliver();
    return failure().empty() ? core::Status{} : core::failure(core::ErrorCode::kForeignPlantFailed);
  }
  // Of the rig's foreign plant; empty: none.
  [[nodiscard]] const std::string& failure() const noexcept { return node_->failure(); }
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
    answers_.forget();
    node_.emplace(rig_, seed_, std::span<const emulator::ScheduledEvent>{}, unrecorded_);
    node_->connect(answers_);
    return core::ErrorCode::kNone;
  }
  // As the driver of a node that is off the bus.
  [[nodiscard]] core::ErrorCode leave_bus() noexcept override {
    return core::ErrorCode::kTransportFailed;
  }

 private:
  struct Commands final : protocol::EachMessage<Commands> {
    explicit Commands(InProcessPlant& owner) noexcept : plant(owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      plant.answers_.give(message, *plant.node_);
    }
    InProcessPlant& plant;
  };

  emulator::RigParameters rig_;
  std::uint64_t seed_;
  UnrecordedPlant unrecorded_;
  TurnAnswers answers_;
  Commands commands_{*this};
  std::optional<emulator::PlantNode> node_;
};

}  // namespace towbench::harness
