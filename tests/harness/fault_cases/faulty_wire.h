// What can go wrong on a wire, done to the frames themselves: between a link and the socket, line
// or bus that carries it. What a fault is done to is chosen by what a frame holds, and when by
// whoever calls strike().
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/random.h"
#include "protocol/byte_stream.h"
#include "protocol/carriers/can_link.h"
#include "protocol/carriers/can_port.h"
#include "protocol/cobs.h"
#include "protocol/frame.h"

namespace towbench::harness {

enum class WireKind : std::uint8_t {
  kLoss,        // a frame does not arrive
  kDuplicate,   // it arrives twice
  kReorder,     // it arrives behind the next of its kind
  kCorruption,  // one of its bits flips
  kFlood,       // many frames that nobody asked for, in each turn
  kJitter,      // what is read comes now and then a few reads late
  kDelay,       // what is read comes later than the receiver waits
  kBabble,      // valid frames without end, but never the awaited one
  kDisconnect,  // the wire ends, on both sides
  kBusOff,      // the sender's node leaves the bus
};

// Which frame: a duty or measurement of axis Y, or the word that ends the turn.
enum class WireTarget : std::uint8_t { kData, kTurn };

struct WireFault {
  WireKind kind = WireKind::kLoss;
  WireTarget target = WireTarget::kData;
  std::size_t bit = 0;  // corruption; counted on from the frame's first, round and round
};

// ---- what a carrier's frames are like ----

using Bytes = std::vector<std::byte>;

constexpr bool is_target(unsigned message_id, WireTarget target) noexcept {
  constexpr unsigned kPwmDuty = 3;
  constexpr unsigned kEncoderEdges = 4;
  constexpr unsigned kAdvance = 10;
  constexpr unsigned kAdvanced = 11;
  return target == WireTarget::kTurn ? message_id == kAdvance || message_id == kAdvanced
                                     : message_id == kPwmDuty || message_id == kEncoderEdges;
}

// Frames of a local socket (frame.h): length, payload, checksum.
struct SocketFrames {
  using Framing = protocol::LengthFraming;
  static std::size_t size_of_first(std::span<const std::byte> bytes) {
    return protocol::kFrameOverhead + protocol::load_little_endian<std::uint16_t>(bytes.data());
  }
  static unsigned message_of(const Bytes& frame) {
    return std::to_integer<unsigned>(frame[protocol::kFrameHeaderSize]);
  }
};

// Frames of a serial line (cobs.h): up to the next zero. A message id is never zero, so it stands
// behind the first byte of the stuffing as it is.
struct LineFrames {
  using Framing = protocol::CobsFraming;
  static std::size_t size_of_first(std::span<const std::byte> bytes) {
    const auto end = std::find(bytes.begin(), bytes.end(), std::byte{0});
    return static_cast<std::size_t>(end - bytes.begin()) + 1;
  }
  static unsigned message_of(const Bytes& frame) { return std::to_integer<unsigned>(frame[1]); }
};

// Frames of a bus (can_layout.h).
struct BusFrames {
  static bool is(const protocol::CanFrame& frame, WireTarget target) {
    namespace can_id = protocol::can_id;
    constexpr std::uint32_t kEitherDirection = ~std::uint32_t{1};
    return target == WireTarget::kTurn ? (frame.id & kEitherDirection) == can_id::kLockstep
                                       : frame.id == can_id::kDuty || frame.id == can_id::kDigest ||
                                             frame.id == can_id::kEdges;
  }
};

// ---- the faults ----

// What happens to the frames that one side sends.
template <typename Frame>
class SendFault {
 public:
  void strike(const WireFault& fault, std::vector<Frame> flood) {
    fault_ = fault;
    flood_ = std::move(flood);
  }

  // `is` says which frame is meant, `flip` flips a bit of one. A fault strikes once, a flood in
  // each turn from then on.
  template <typename Is, typename Flip>
  void act(std::vector<Frame>& turn, Is is, Flip flip) {
    if (!fault_) {
      return;
    }
    if (fault_->kind == WireKind::kFlood) {
      turn.insert(turn.begin(), flood_.begin(), flood_.end());
      return;
    }
    const auto found = std::find_if(turn.begin(), turn.end(), is);
    if (found == turn.end()) {
      return;
    }
    switch (fault_->kind) {
      case WireKind::kLoss:
        turn.erase(found);
        break;
      case WireKind::kDuplicate:
        turn.insert(found, Frame(*found));
        break;
      case WireKind::kCorruption:
        flip(*found);
        break;
      case WireKind::kReorder:
        if (!held_) {
          held_ = *found;
          turn.erase(found);
          return;  // strikes when the next one comes
        }
        turn.insert(found + 1, *held_);
        break;
      default:
        break;
    }
    fault_.reset();
  }
  [[nodiscard]] const std::optional<WireFault>& fault() const noexcept { return fault_; }

 private:
  std::optional<WireFault> fault_;
  std::vector<Frame> flood_;
  std::optional<Frame> held_;
};

// What happens to whoever reads. True: nothing comes out of this read.
class ReadFault {
 public:
  void strike(WireKind kind) noexcept { kind_ = kind; }
  [[nodiscard]] bool babbles() const noexcept { return kind_ == WireKind::kBabble; }
  [[nodiscard]] bool holds_back() noexcept {
    constexpr double kShare = 0.3;
    return kind_ == WireKind::kDelay || (kind_ == WireKind::kJitter && random_.uniform() < kShare);
  }

 private:
  std::optional<WireKind> kind_;
  core::Random random_{1};
};

// ---- the wires ----

template <typename Frames>
class FaultyStream final : public protocol::ByteStream {
 public:
  // `inner` outlives this.
  explicit FaultyStream(protocol::ByteStream& inner) : inner_(inner) {}

  void strike_sender(const WireFault& fault) {
    constexpr std::size_t kMessages = 40;
    send_.strike(fault, std::vector<Bytes>(kMessages, unasked()));
  }
  void strike_reader(WireKind kind) { read_.strike(kind); }
  void cut(core::ErrorCode why) { cut_ = why; }

  core::Status write(std::span<const std::byte> bytes) noexcept override {
    if (cut_ != core::ErrorCode::kNone) {
      return core::failure(cut_);
    }
    std::vector<Bytes> turn;
    for (auto rest = bytes; !rest.empty(); rest = rest.subspan(turn.back().size())) {
      const auto frame = rest.first(std::min(rest.size(), Frames::size_of_first(rest)));
      turn.emplace_back(frame.begin(), frame.end());
    }
    const auto fault = send_.fault().value_or(WireFault{});
    send_.act(
        turn,
        [&](const Bytes& frame) { return is_target(Frames::message_of(frame), fault.target); },
        [&](Bytes& frame) {
          const std::size_t bit = fault.bit % (8 * frame.size());
          frame[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
        });
    Bytes together;
    for (const auto& frame : turn) {
      together.insert(together.end(), frame.begin(), frame.end());
    }
    return together.empty() ? core::Status() : inner_.write(together);
  }
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override {
    if (cut_ != core::ErrorCode::kNone) {
      return core::failure(cut_);
    }
    if (read_.holds_back()) {
      return std::size_t{0};
    }
    if (read_.babbles()) {
      const auto frame = unasked();
      std::copy(frame.begin(), frame.end(), into.begin());
      return frame.size();
    }
    return inner_.read_some(into, timeout_ns);
  }

 private:
  // A message that either side understands and has no use for.
  static Bytes unasked() {
    Bytes frame(Frames::Framing::kMaxFrameSize);
    frame.resize(Frames::Framing::append(protocol::CurrentSample{}, frame));
    return frame;
  }

  protocol::ByteStream& inner_;
  SendFault<Bytes> send_;
  ReadFault read_;
  core::ErrorCode cut_ = core::ErrorCode::kNone;
};

class FaultyBus final : public protocol::CanPort {
 public:
  // `inner` outlives this; `direction` is where its own frames go.
  FaultyBus(protocol::CanPort& inner, protocol::CanDirection direction)
      : inner_(inner), direction_(direction) {}

  [[nodiscard]] bool carries_fd() const noexcept override { return inner_.carries_fd(); }
  void strike_sender(const WireFault& fault) {
    constexpr std::size_t kMessages = 10;
    Collected flood;
    protocol::CanPacker packer(direction_, flood);
    for (std::size_t i = 0; i < kMessages; ++i) {
      constexpr std::uint32_t kForeign = 0x333;
      packer.on(protocol::CurrentSample{});
      flood.frames.push_back(protocol::can_frame(kForeign, i));
    }
    send_.strike(fault, flood.frames);
  }
  void strike_reader(WireKind kind) { read_.strike(kind); }
  void cut(core::ErrorCode why) { cut_ = why; }

  core::Status send(std::span<const protocol::CanFrame> frames) noexcept override {
    if (cut_ != core::ErrorCode::kNone) {
      return core::failure(cut_);
    }
    std::vector<protocol::CanFrame> turn(frames.begin(), frames.end());
    const auto target = send_.fault().value_or(WireFault{}).target;
    send_.act(
        turn, [&](const protocol::CanFrame& frame) { return BusFrames::is(frame, target); },
        [](protocol::CanFrame& /*frame*/) {});  // no bus: a controller repeats a damaged frame
    return turn.empty() ? core::Status() : inner_.send(turn);
  }
  core::Result<std::size_t> receive(std::span<protocol::CanFrame> into,
                                    core::Nanoseconds timeout_ns) noexcept override {
    if (cut_ != core::ErrorCode::kNone) {
      return core::failure(cut_);
    }
    if (read_.holds_back()) {
      return std::size_t{0};
    }
    if (read_.babbles()) {
      const auto sender = direction_ == protocol::CanDirection::kToPlant
                              ? protocol::CanDirection::kToController
                              : protocol::CanDirection::kToPlant;
      Collected babble;
      protocol::CanPacker(sender, babble).on(protocol::CurrentSample{});
      std::copy(babble.frames.begin(), babble.frames.end(), into.begin());
      return babble.frames.size();
    }
    return inner_.receive(into, timeout_ns);
  }

 private:
  struct Collected final : protocol::CanFrameSink {
    void on(const protocol::CanFrame& frame) noexcept override { frames.push_back(frame); }
    std::vector<protocol::CanFrame> frames;
  };

  protocol::CanPort& inner_;
  protocol::CanDirection direction_;
  SendFault<protocol::CanFrame> send_;
  ReadFault read_;
  core::ErrorCode cut_ = core::ErrorCode::kNone;
};

}  // namespace towbench::harness
