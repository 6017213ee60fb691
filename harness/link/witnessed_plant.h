// Passes everything on between a controller and its plant, and tells a witness what the controller
// heard: the messages of each exchange, then an Advance with the controller's time.
#pragma once

#include "harness/link/plant_end.h"
#include "protocol/each_message.h"

namespace towbench::harness {

class WitnessedPlant final : public PlantEnd {
 public:
  // Both outlive this.
  WitnessedPlant(PlantEnd& plant, protocol::MessageSink& witness) noexcept
      : plant_(plant), heard_(witness) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return plant_.sink(); }
  void connect(protocol::MessageSink& controller) noexcept override {
    heard_.to = &controller;
    plant_.connect(heard_);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    const auto status = plant_.wait_for(expected);
    heard_.witness.on(protocol::Advance{.until_ns = heard_.time_ns});
    return status;
  }
  [[nodiscard]] bool happen(const emulator::ScheduledEvent& event) override {
    return plant_.happen(event);
  }
  [[nodiscard]] bool disturb(const LinkFault& fault) override { return plant_.disturb(fault); }

 private:
  struct Heard final : protocol::EachMessage<Heard> {
    explicit Heard(protocol::MessageSink& the_witness) noexcept : witness(the_witness) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      witness.on(message);
      to->on(message);
    }
    void handle(const protocol::Advanced& advanced) noexcept {
      time_ns = advanced.time_ns;
      witness.on(advanced);
      to->on(advanced);
    }
    protocol::MessageSink& witness;
    protocol::MessageSink* to = nullptr;
    core::Nanoseconds time_ns = 0;
  };

  PlantEnd& plant_;
  Heard heard_;
};

}  // namespace towbench::harness
