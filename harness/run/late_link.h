// A link that is sound until somebody breaks it: what a run needs that a person may disturb and
// mostly does not. Until then messages only pass; a CaseLink, which notes every edge that crosses,
// comes between when the first fault does, and finds nothing that it should have known.
#pragma once

#include <optional>

#include "harness/fault_cases/case_link.h"
#include "harness/link/peer_control.h"
#include "harness/link/plant_end.h"
#include "protocol/each_message.h"

namespace towbench::harness {

class LateLink final : public PlantEnd {
 public:
  // Both outlive this.
  LateLink(PlantEnd& plant, PeerControl& peer) noexcept
      : plant_(plant), peer_(peer), to_plant_(plant.sink()) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    controller_ = &controller;
    plant_.connect(controller);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    return broken_ ? broken_->wait_for(expected) : plant_.wait_for(expected);
  }
  [[nodiscard]] bool happen(const emulator::ScheduledEvent& event) override {
    return plant_.happen(event);
  }
  [[nodiscard]] bool disturb(const LinkFault& fault) override {
    if (!broken_) {
      broken_.emplace(plant_, peer_, std::vector<LinkFault>{}, crossed_);
      broken_->connect(*controller_);
      to_plant_.to = &broken_->sink();
    }
    return broken_->disturb(fault);
  }

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(protocol::MessageSink& plant) noexcept : to(&plant) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to->on(message);
    }
    protocol::MessageSink* to;
  };

  PlantEnd& plant_;
  PeerControl& peer_;
  ToPlant to_plant_;
  protocol::MessageSink* controller_ = nullptr;
  CaseRecord crossed_;  // what it notes is of no use here: the judge makes its own
  std::optional<CaseLink> broken_;
};

}  // namespace towbench::harness
