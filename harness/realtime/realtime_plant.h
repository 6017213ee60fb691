// Both ends of a run by the wall clock, on top of the same messages as lockstep.
//
// Each side has its own loop and its own monotonic clock. The plant steps at 10 kHz whatever the
// controller does and sends what it measured at once (over a bus: once an exchange); the controller
// is served each exchange with
// what has arrived by then. Advance does not cross the wire: a heartbeat in each exchange shows
// that the controller lives.
#pragma once

#include "core/result.h"
#include "emulator/plant_node.h"
#include "emulator/plant_relay.h"
#include "harness/link/plant_end.h"
#include "harness/link/wires.h"
#include "harness/realtime/tick_loop.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/each_message.h"

namespace towbench::harness {

// A side that was not heard for so long is lost.
inline constexpr core::Nanoseconds kRealtimeSilence_ns = core::kNanosecondsPerSecond;

// What stands around the plant; all outlives the service.
struct PlantSurroundings {
  PlantWires wires;  // the machine's real lines
  // A whole number of ticks: how often the plant reports. Each tick is the least delay; a bus bears
  // one report an exchange.
  core::Nanoseconds report_ns = core::kPlantTick_ns;
  // Hears all that the plant hears, in that order: an Advance for each tick too. May be null.
  protocol::MessageSink* witness = nullptr;
};

// The emulator's side: serves until Bye (success) or until the controller or a line is lost; then
// the drive has been removed and the reason is returned. The loop's period is the plant's tick.
[[nodiscard]] core::Status serve_plant_in_real_time(emulator::PlantNode& plant,
                                                    protocol::TurnLink& link,
                                                    const protocol::Hello& hello, TickLoop& loop,
                                                    const PlantSurroundings& around = {});

// Passes on truth at whole exchanges, as a lockstep run records it; all else as it is.
class ThinnedTruth final : public emulator::PlantRelay {
 public:
  // `to` outlives this.
  ThinnedTruth(emulator::PlantObserver& to, core::Nanoseconds exchange_ns) noexcept
      : PlantRelay(to), exchange_ns_(exchange_ns) {}
  void on_truth(const emulator::TruthRow& row) noexcept override;

 private:
  core::Nanoseconds exchange_ns_;
};

// The controller's side. The loop's period is the exchange.
class RealtimePlantEnd final : public PlantEnd {
 public:
  // Both outlive this. Without `takes_edges` the plant is asked for the digest, whatever the
  // controller could decode.
  RealtimePlantEnd(protocol::TurnLink& link, TickLoop& loop, bool takes_edges = true) noexcept
      : link_(link), loop_(loop), to_plant_(link.peer(), takes_edges) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    to_controller_.to = &controller;
  }
  // kAdvanced: sleeps until the exchange is over and delivers what has come. The controller is told
  // its own time.
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    ToPlant(protocol::MessageSink& link_to, bool edges) noexcept
        : to(link_to), takes_edges(edges) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::Hello& hello) noexcept {
      protocol::Hello asked = hello;
      asked.capabilities &= takes_edges ? asked.capabilities : ~protocol::kCapabilityEdges;
      to.on(asked);
    }
    void handle(const protocol::Advance& advance) noexcept {
      until_ns = advance.until_ns;
      to.on(protocol::Heartbeat{.time_ns = advance.until_ns, .sequence = heartbeats++});
    }
    protocol::MessageSink& to;
    bool takes_edges;
    core::Nanoseconds until_ns = 0;
    std::uint32_t heartbeats = 0;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    template <typename Message>
    void handle(const Message& message) noexcept {
      heard = true;
      to->on(message);
    }
    void handle(const protocol::Advanced& /*advanced*/) noexcept { heard = true; }
    void handle(const protocol::Bye& bye) noexcept {
      ended = true;
      to->on(bye);
    }
    protocol::MessageSink* to = nullptr;
    bool heard = false;
    bool ended = false;
  };

  protocol::TurnLink& link_;
  TickLoop& loop_;
  ToPlant to_plant_;
  ToController to_controller_;
  core::Nanoseconds last_heard_ns_ = 0;
};

}  // namespace towbench::harness
