// A run over a CAN bus. The frames of a turn go out together.
//
// By the wall clock no time crosses the bus: Advance, Advanced and Heartbeat end a turn as ever,
// but only one in fifty becomes a frame, which tells that its side lives; the rest would be a third
// of the bus.
//
// A classic bus carries the digest, not edges, so this takes "edges" out of the capabilities of the
// Hello that it sends and of the one that it hears: the plant then chooses what both ends can
// carry. Edges go over FD frames, where the port has them. A bus has no end of stream: a peer that
// dies is noticed after the silence limit.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/carriers/can_packer.h"
#include "protocol/carriers/can_port.h"
#include "protocol/carriers/can_unpacker.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/stream_writer.h"

namespace towbench::protocol {

class CanLink final : public TurnLink {
 public:
  // `direction` is where our own frames go. `port` outlives this.
  CanLink(CanPort& port, CanDirection direction,
          core::Nanoseconds silence_limit_ns = core::kNanosecondsPerSecond) noexcept;

  // Both sides of a run by the wall clock, before its first turn.
  void go_by_the_wall_clock() noexcept { writer_.quiet = true; }

  // Every frame sent and received, in order, also goes there. Outlives this.
  void log_to(CanFrameSink& log) noexcept { log_ = &log; }

  [[nodiscard]] MessageSink& peer() noexcept override { return writer_; }
  [[nodiscard]] const LinkCounts& counts() const noexcept override { return unpacker_.counts(); }
  [[nodiscard]] std::uint64_t frames_sent() const noexcept { return writer_.frames_sent; }
  // With the worst stuffing, both rates of FD frames together.
  [[nodiscard]] std::uint64_t bits_sent() const noexcept { return writer_.bits_sent; }
  [[nodiscard]] std::uint64_t bits_received() const noexcept { return bits_received_; }
  [[nodiscard]] std::uint64_t frames_received() const noexcept { return frames_received_; }
  // Messages that CAN does not carry, and reports that could not be expanded (can_unpacker.h).
  [[nodiscard]] std::uint64_t refused() const noexcept { return writer_.packer.refused(); }
  [[nodiscard]] std::uint64_t reports_without_reference() const noexcept {
    return unpacker_.reports_without_reference();
  }

 private:
  // Holds the frames of a turn.
  struct Queue final : CanFrameSink {
    explicit Queue(CanLink& owner) noexcept : link(owner) {}
    void on(const CanFrame& frame) noexcept override;
    void flush() noexcept;

    CanLink& link;
    core::Status status{};
    std::size_t held = 0;
    std::array<CanFrame, 256> frames{};
  };
  template <typename Message>
  static constexpr bool kTellsTimeOnly =
      std::is_same_v<Message, Advance> || std::is_same_v<Message, Advanced> ||
      std::is_same_v<Message, Heartbeat>;
  static constexpr std::uint64_t kTurnsBetweenSigns = 50;
  struct Writer final : EachMessage<Writer> {
    Writer(CanLink& owner, CanDirection direction, bool carries_fd) noexcept
        : queue(owner),
          capabilities(carries_fd ? ~0U : ~kCapabilityEdges),
          packer(direction, queue, carries_fd) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      if constexpr (std::is_same_v<Message, Hello>) {
        Hello ours = message;
        ours.capabilities &= capabilities;
        packer.on(ours);
      } else if constexpr (std::is_same_v<Message, HelloReply>) {
        HelloReply ours = message;
        ours.plant.capabilities &= capabilities;
        packer.on(ours);
      } else if constexpr (kTellsTimeOnly<Message>) {
        if (!quiet || time_messages++ % kTurnsBetweenSigns == 0) {
          packer.on(message);
        }
      } else {
        packer.on(message);
      }
      if constexpr (kEndsTurn<Message>) {
        queue.flush();
      }
    }

    Queue queue;
    std::uint32_t capabilities;  // of any side on this bus
    CanPacker packer;
    std::uint64_t frames_sent = 0;
    std::uint64_t bits_sent = 0;
    bool quiet = false;
    std::uint64_t time_messages = 0;
  };

  // On to the watch; what the bus cannot carry is not heard of.
  struct Hearer final : EachMessage<Hearer> {
    explicit Hearer(CanLink& owner) noexcept : link(owner) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      link.watch().on(message);
    }
    void handle(const Hello& message) noexcept {
      Hello theirs = message;
      theirs.capabilities &= link.writer_.capabilities;
      link.watch().on(theirs);
    }
    CanLink& link;
  };

  core::Result<Progress> read_once(core::Nanoseconds timeout_ns) noexcept override;

  CanPort& port_;
  CanFrameSink* log_ = nullptr;
  Writer writer_;
  CanUnpacker unpacker_;
  Hearer hearer_{*this};
  std::uint64_t frames_received_ = 0;
  std::uint64_t bits_received_ = 0;
  std::array<CanFrame, 64> received_{};
};

}  // namespace towbench::protocol
