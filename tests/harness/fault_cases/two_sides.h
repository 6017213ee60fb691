// A whole bench over a real wire with both of its sides in one thread: the controller's turn goes
// out, the plant's side takes it off the wire and answers, the controller's side takes that. So
// nobody has to be waited for, and what a test strikes strikes in the same exchange every time.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include <net/if.h>

#include "emulator/plant_node.h"
#include "harness/link/plant_end.h"
#include "harness/link/pty_line.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"
#include "protocol/carriers/serial_port.h"
#include "protocol/each_message.h"
#include "tests/harness/fault_cases/faulty_wire.h"

namespace towbench::harness {

enum class WireName : std::uint8_t { kSocket, kLine, kBus, kFdBus };

// One side's end of a wire: the link, and what may happen to it.
class WireEnd {
 public:
  WireEnd() = default;
  WireEnd(const WireEnd&) = delete;
  WireEnd& operator=(const WireEnd&) = delete;
  virtual ~WireEnd() = default;
  virtual protocol::TurnLink& link() = 0;
  virtual void strike_sender(const WireFault& fault) = 0;
  virtual void strike_reader(WireKind kind) = 0;
  virtual void cut(core::ErrorCode why) = 0;
};

template <typename Faulty, typename Link, typename Inner>
class EndOver final : public WireEnd {
 public:
  template <typename... Direction>
  EndOver(std::unique_ptr<Inner> inner, core::Nanoseconds silence_ns, Direction... direction)
      : inner_(std::move(inner)),
        faulty_(*inner_, direction...),
        link_(faulty_, direction..., silence_ns) {}
  protocol::TurnLink& link() override { return link_; }
  void strike_sender(const WireFault& fault) override { faulty_.strike_sender(fault); }
  void strike_reader(WireKind kind) override { faulty_.strike_reader(kind); }
  void cut(core::ErrorCode why) override { faulty_.cut(why); }

 private:
  std::unique_ptr<Inner> inner_;
  Faulty faulty_;
  Link link_;
};

// A bus in memory. A node that has left hears and is heard no more.
struct MemoryBus {
  std::deque<protocol::CanFrame> to_plant;
  std::deque<protocol::CanFrame> to_controller;
};

class MemoryNode final : public protocol::CanPort {
 public:
  MemoryNode(std::deque<protocol::CanFrame>& out, std::deque<protocol::CanFrame>& in, bool has_fd)
      : out_(out), in_(in), has_fd_(has_fd) {}
  [[nodiscard]] bool carries_fd() const noexcept override { return has_fd_; }
  core::Status send(std::span<const protocol::CanFrame> frames) noexcept override {
    out_.insert(out_.end(), frames.begin(), frames.end());
    return {};
  }
  core::Result<std::size_t> receive(std::span<protocol::CanFrame> into,
                                    core::Nanoseconds /*timeout_ns*/) noexcept override {
    std::size_t size = 0;
    for (; size < into.size() && !in_.empty(); in_.pop_front()) {
      into[size++] = in_.front();
    }
    return size;
  }

 private:
  std::deque<protocol::CanFrame>& out_;
  std::deque<protocol::CanFrame>& in_;
  bool has_fd_;
};

// Both ends of one wire, and what it runs through.
struct WholeWire {
  explicit WholeWire(WireName name) {
    using protocol::CanDirection;
    constexpr auto kSilence_ns = 100 * core::kNanosecondsPerMillisecond;
    constexpr auto kSilenceOfLine_ns = 400 * core::kNanosecondsPerMillisecond;  // threads carry it
    constexpr std::uint32_t kBaud = 921'600;
    using protocol::LocalSocket;
    using protocol::SerialPort;
    if (name == WireName::kSocket) {
      using SocketEnd = EndOver<FaultyStream<SocketFrames>, protocol::LockstepLink, LocalSocket>;
      auto pair = LocalSocket::pair();
      near = std::make_unique<SocketEnd>(std::move(pair->first), kSilence_ns);
      far = std::make_unique<SocketEnd>(std::move(pair->second), kSilence_ns);
    } else if (name == WireName::kLine) {
      using LineEnd = EndOver<FaultyStream<LineFrames>, protocol::SerialLockstepLink, SerialPort>;
      line = std::make_unique<PtyLine>();
      near = std::make_unique<LineEnd>(std::move(*SerialPort::open(line->near_end(), kBaud)),
                                       kSilenceOfLine_ns);
      far = std::make_unique<LineEnd>(std::move(*SerialPort::open(line->far_end(), kBaud)),
                                      kSilenceOfLine_ns);
    } else {
      const bool has_fd = name == WireName::kFdBus;
      using BusEnd = EndOver<FaultyBus, protocol::CanLink, MemoryNode>;
      near = std::make_unique<BusEnd>(
          std::make_unique<MemoryNode>(bus.to_plant, bus.to_controller, has_fd), kSilence_ns,
          CanDirection::kToPlant);
      far = std::make_unique<BusEnd>(
          std::make_unique<MemoryNode>(bus.to_controller, bus.to_plant, has_fd), kSilence_ns,
          CanDirection::kToController);
    }
  }

  std::unique_ptr<PtyLine> line;
  MemoryBus bus;
  std::unique_ptr<WireEnd> near;  // the controller's
  std::unique_ptr<WireEnd> far;   // the plant's
};

// The plant at the far end, and what the controller told it last.
class TwoSides final : public PlantEnd {
 public:
  // A version that is not ours, said by this side.
  enum class OtherVersion : std::uint8_t { kNobody, kController, kPlant };

  TwoSides(WireName name, const emulator::RigParameters& rig, emulator::PlantObserver& observer,
           OtherVersion other_version = OtherVersion::kNobody)
      : wire_(name),
        plant_(rig, 1, {}, observer),
        to_plant_(wire_.near->link().peer(), other_version == OtherVersion::kController),
        to_controller_(wire_.far->link().peer(), other_version == OtherVersion::kPlant) {
    plant_.connect(to_controller_);
  }

  // In the turn of this number: the exchange before `time_ns`, of a millisecond each, behind the
  // greeting and the exchange of no length.
  void strike_at(core::Nanoseconds time_ns, const WireFault& fault, bool to_plant) {
    constexpr core::Nanoseconds kBeforeTheFirst = 2;
    struck_turn_ = time_ns / core::kNanosecondsPerMillisecond + kBeforeTheFirst;
    fault_ = fault;
    fault_is_to_plant_ = to_plant;
  }

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override { controller_ = &controller; }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    serve_plant();
    if (++turns_ == struck_turn_) {
      strike();
    }
    return wire_.near->link().wait_for(expected, *controller_);
  }

  // The controller's process is over: its end closes, and the plant is served until it knows.
  void controller_leaves() {
    wire_.near.reset();
    while (!plant_.finished()) {
      serve_plant();
    }
  }
  [[nodiscard]] bool controller_drives(core::Axis axis) const { return to_plant_.drives[axis]; }

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    ToPlant(protocol::MessageSink& peer, bool other_version)
        : to(peer), speaks_other_version(other_version) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::Hello& hello) noexcept {
      auto said = hello;
      said.version = static_cast<std::uint16_t>(hello.version + (speaks_other_version ? 1 : 0));
      to.on(said);
    }
    void handle(const protocol::PwmDuty& duty) noexcept {
      drives[duty.axis] = duty.enable && (duty.channel_a_ticks != 0 || duty.channel_b_ticks != 0);
      to.on(duty);
    }
    protocol::MessageSink& to;
    bool speaks_other_version;
    core::PerAxis<bool> drives;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    ToController(protocol::MessageSink& peer, bool other_version)
        : to(peer), speaks_other_version(other_version) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::HelloReply& reply) noexcept {
      auto said = reply;
      said.plant.version =
          static_cast<std::uint16_t>(reply.plant.version + (speaks_other_version ? 1 : 0));
      to.on(said);
    }
    protocol::MessageSink& to;
    bool speaks_other_version;
  };

  // As harness/link/plant_service.h does, a turn of it.
  void serve_plant() noexcept {
    if (plant_.finished()) {
      return;
    }
    if (const auto turn = wire_.far->link().wait(plant_); !turn) {
      plant_.peer_lost(turn.error());
    }
    if (plant_.finished()) {
      wire_.far.reset();  // its process ends
    }
  }
  void strike() {
    auto& sender = fault_is_to_plant_ ? wire_.near : wire_.far;
    auto& reader = fault_is_to_plant_ ? wire_.far : wire_.near;
    switch (fault_.kind) {
      case WireKind::kDisconnect:
        wire_.near->cut(core::ErrorCode::kPeerClosed);
        wire_.far->cut(core::ErrorCode::kPeerClosed);
        break;
      case WireKind::kBusOff:
        sender->cut(core::ErrorCode::kTransportFailed);
        break;
      case WireKind::kJitter:
      case WireKind::kDelay:
      case WireKind::kBabble:
        reader->strike_reader(fault_.kind);
        break;
      default:
        sender->strike_sender(fault_);
        break;
    }
  }

  WholeWire wire_;
  emulator::PlantNode plant_;
  ToPlant to_plant_;
  ToController to_controller_;
  protocol::MessageSink* controller_ = nullptr;
  WireFault fault_;
  bool fault_is_to_plant_ = false;
  core::Nanoseconds struck_turn_ = -1;
  core::Nanoseconds turns_ = 0;
};

}  // namespace towbench::harness
