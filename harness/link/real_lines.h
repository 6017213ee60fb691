// A run whose digital lines are real ones while everything else goes over its carrier.
//
// Plant's side: a change of the machine's lines is on the wire before the turn ends; before each
// step the amplifier enables are read. Controller's side: the lines are read at the end of each
// turn. So a change is seen in the exchange in which it happens, dated to that exchange's end: a
// level has no time of the run's own.
#pragma once

#include <cstdint>
#include <optional>

#include "harness/link/plant_end.h"
#include "protocol/carriers/line_port.h"
#include "protocol/each_message.h"

namespace towbench::harness {

class RealLinesAtController final : public PlantEnd {
 public:
  // Both outlive this.
  RealLinesAtController(PlantEnd& plant, protocol::LinePort& port) noexcept
      : plant_(plant), port_(port) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    to_controller_.to = &controller;
    plant_.connect(to_controller_);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(RealLinesAtController& the_owner) noexcept : owner(the_owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      owner.plant_.sink().on(message);
    }
    void handle(const protocol::DigitalOutputs& outputs) noexcept;
    void handle(const protocol::Advance& advance) noexcept;
    RealLinesAtController& owner;
  };
  // Lines that come as messages are not those of the machine.
  struct ToController final : protocol::EachMessage<ToController> {
    template <typename Message>
    void handle(const Message& message) noexcept {
      to->on(message);
    }
    void handle(const protocol::DigitalInputs& /*inputs*/) noexcept {}
    protocol::MessageSink* to = nullptr;
  };

  PlantEnd& plant_;
  protocol::LinePort& port_;
  ToPlant to_plant_{*this};
  ToController to_controller_;
  core::Status status_;
  core::Nanoseconds until_ns_ = 0;
  std::optional<std::uint16_t> seen_;
  std::uint32_t sequence_ = 0;
};

// Stands on both ways of the plant: `from_controller()` in front of it, `to_controller()` behind.
class RealLinesAtPlant {
 public:
  // All outlive this.
  RealLinesAtPlant(protocol::MessageSink& plant, protocol::MessageSink& controller,
                   protocol::LinePort& port) noexcept
      : in_(*this, plant), out_(*this, controller), port_(port) {}

  [[nodiscard]] protocol::MessageSink& from_controller() noexcept { return in_; }
  [[nodiscard]] protocol::MessageSink& to_controller() noexcept { return out_; }
  // The first failure of the lines.
  [[nodiscard]] core::Status status() const noexcept { return status_; }

 private:
  struct In final : protocol::EachMessage<In> {
    In(RealLinesAtPlant& the_owner, protocol::MessageSink& plant) noexcept
        : owner(the_owner), to(plant) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::DigitalOutputs& /*outputs*/) noexcept {}
    void handle(const protocol::Advance& advance) noexcept;
    RealLinesAtPlant& owner;
    protocol::MessageSink& to;
  };
  struct Out final : protocol::EachMessage<Out> {
    Out(RealLinesAtPlant& the_owner, protocol::MessageSink& controller) noexcept
        : owner(the_owner), to(controller) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::DigitalInputs& inputs) noexcept;
    RealLinesAtPlant& owner;
    protocol::MessageSink& to;
  };

  In in_;
  Out out_;
  protocol::LinePort& port_;
  core::Status status_;
  std::optional<std::uint16_t> seen_;
  std::uint32_t sequence_ = 0;
  core::Nanoseconds now_ns_ = 0;
};

}  // namespace towbench::harness
