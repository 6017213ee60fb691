// Gives a virtual bus the rate of a wire: a frame is received no earlier than a bus of that rate
// could have carried it, after every frame that this node has sent or heard before. A bus is
// shared, so what this node sends keeps the wire busy too. Frames count with the worst bit
// stuffing.
//
// As with PacedStream, pacing sits at the receiving end, where time is seen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/carriers/can_port.h"
#include "protocol/carriers/paced_stream.h"

namespace towbench::protocol {

// A bus as its address names it: INTERFACE, INTERFACE@BIT/S, or with FD frames: INTERFACE@fd,
// INTERFACE@BIT/S/BIT/S with the rate of their data.
struct NamedBus {
  std::string interface;
  std::uint32_t bit_per_s = 0;       // 0: not named
  std::uint32_t data_bit_per_s = 0;  // the same
  bool is_fd = false;
};

// Nothing for a rate that is none.
[[nodiscard]] std::optional<NamedBus> named_bus(std::string_view place);

class PacedCan final : public CanPort {
 public:
  // Both outlive this.
  // A data rate of 0: FD frames go at the one rate.
  PacedCan(CanPort& bus, WireClock& clock, std::uint64_t bit_per_s,
           std::uint64_t data_bit_per_s = 0) noexcept
      : bus_(bus),
        clock_(clock),
        pacer_(bit_per_s),
        bit_per_s_(bit_per_s),
        data_bit_per_s_(data_bit_per_s == 0 ? bit_per_s : data_bit_per_s) {}

  [[nodiscard]] bool carries_fd() const noexcept override { return bus_.carries_fd(); }

  core::Status send(std::span<const CanFrame> frames) noexcept override;
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds timeout_ns) noexcept override;

 private:
  struct UnderWay {
    CanFrame frame;
    core::Nanoseconds arrival_ns = 0;
  };
  static constexpr std::size_t kCapacity = 512;  // what is more waits in the kernel

  // What a frame takes of the bus, in bits of its nominal rate.
  [[nodiscard]] std::uint64_t bits_of(const CanFrame& frame) const noexcept;
  core::Status take_in(core::Nanoseconds timeout_ns) noexcept;
  std::size_t hand_out(std::span<CanFrame> into) noexcept;

  CanPort& bus_;
  WireClock& clock_;
  WirePacer pacer_;
  std::uint64_t bit_per_s_;
  std::uint64_t data_bit_per_s_;
  core::Status ended_;
  std::size_t first_ = 0;
  std::size_t held_ = 0;
  std::array<UnderWay, kCapacity> under_way_;
  std::array<CanFrame, 64> received_;
};

}  // namespace towbench::protocol
