// Both ends of a run by the wall clock, on top of the same messages as lockstep.
//
// Each side has its own loop and its own monotonic clock. The plant steps at 10 kHz whatever the
// controller does and sends what it measured at once; the controller is served each exchange with
// what has arrived by then. Advance does not cross the wire: a heartbeat in each exchange shows
// that the controller lives.
#pragma once

#include "core/result.h"
#include "emulator/plant_node.h"
#include "harness/bench/plant_end.h"
#include "harness/realtime/tick_loop.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/each_message.h"

namespace towbench::harness {

// A side that was not heard for so long is lost.
inline constexpr core::Nanoseconds kRealtimeSilence_ns = core::kNanosecondsPerSecond;

// The emulator's side: serves until Bye (success) or until the controller is lost; then the drive
// has been removed and the reason is returned. The loop's period is the plant's tick.
[[nodiscard]] core::Status serve_plant_in_real_time(emulator::PlantNode& plant,
                                                    protocol::TurnLink& link,
                                                    const protocol::Hello& hello, TickLoop& loop);

// Passes on the rows of truth at whole exchanges, as a lockstep run records them; every event.
class ThinnedTruth final : public emulator::PlantObserver {
 public:
  // `to` outlives this.
  ThinnedTruth(emulator::PlantObserver& to, core::Nanoseconds exchange_ns) noexcept
      : to_(to), exchange_ns_(exchange_ns) {}
  void on_truth(const emulator::TruthRow& row) noexcept override;
  void on_event(const emulator::PlantEvent& event) noexcept override { to_.on_event(event); }

 private:
  emulator::PlantObserver& to_;
  core::Nanoseconds exchange_ns_;
};

// The controller's side. The loop's period is the exchange.
class RealtimePlantEnd final : public PlantEnd {
 public:
  // Both outlive this.
  RealtimePlantEnd(protocol::TurnLink& link, TickLoop& loop) noexcept
      : link_(link), loop_(loop), to_plant_(link.peer()) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override {
    to_controller_.to = &controller;
  }
  // kAdvanced: sleeps until the exchange is over and delivers what has come. The controller is told
  // its own time.
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    explicit ToPlant(protocol::MessageSink& link_to) noexcept : to(link_to) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::Advance& advance) noexcept {
      until_ns = advance.until_ns;
      to.on(protocol::Heartbeat{.time_ns = advance.until_ns, .sequence = heartbeats++});
    }
    protocol::MessageSink& to;
    core::Nanoseconds until_ns = 0;
    std::uint32_t heartbeats = 0;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    template <typename Message>
    void handle(const Message& message) noexcept {
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
