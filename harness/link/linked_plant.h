// The plant in another process, over any carrier.
#pragma once

#include "harness/link/plant_end.h"
#include "protocol/carriers/turn_link.h"

namespace towbench::harness {

class LinkedPlant final : public PlantEnd {
 public:
  // The link outlives this.
  explicit LinkedPlant(protocol::TurnLink& link) noexcept : link_(link) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return link_.peer(); }
  void connect(protocol::MessageSink& controller) noexcept override { controller_ = &controller; }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    return link_.wait_for(expected, *controller_);
  }

 private:
  protocol::TurnLink& link_;
  protocol::MessageSink* controller_ = nullptr;
};

}  // namespace towbench::harness
