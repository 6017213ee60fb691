// The plant in another process, over a byte stream.
#pragma once

#include "harness/bench/plant_end.h"
#include "protocol/byte_stream.h"

namespace towbench::harness {

class LinkedPlant final : public PlantEnd {
 public:
  // The stream outlives this.
  explicit LinkedPlant(protocol::ByteStream& stream) noexcept : link_(stream) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return link_.peer(); }
  void connect(protocol::MessageSink& controller) noexcept override { controller_ = &controller; }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    return link_.wait_for(expected, *controller_);
  }

 private:
  protocol::LockstepLink link_;
  protocol::MessageSink* controller_ = nullptr;
};

}  // namespace towbench::harness
