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

// A bus as its address names it: INTERFACE, or INTERFACE@BIT/S.
struct NamedBus {
  std::string interface;
  std::uint32_t bit_per_s = 0;  // 0: not named
};

// Nothing for a rate that is none.
[[nodiscard]] std::optional<NamedBus> named_bus(std::string_view place);

class PacedCan final : public CanPort {
 public:
  // Both outlive this.
  PacedCan(CanPort& bus, WireClock& clock, std::uint64_t bit_per_s) noexcept
      : bus_(bus), clock_(clock), pacer_(bit_per_s) {}

  core::Status send(std::span<const CanFrame> frames) noexcept override;
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds timeout_ns) noexcept override;

 private:
  struct UnderWay {
    CanFrame frame;
    core::Nanoseconds arrival_ns = 0;
  };
  static constexpr std::size_t kCapacity = 512;  // what is more waits in the kernel

  core::Status take_in(core::Nanoseconds timeout_ns) noexcept;
  std::size_t hand_out(std::span<CanFrame> into) noexcept;

  CanPort& bus_;
  WireClock& clock_;
  WirePacer pacer_;
  core::Status ended_;
  std::size_t first_ = 0;
  std::size_t held_ = 0;
  std::array<UnderWay, kCapacity> under_way_;
  std::array<CanFrame, 64> received_;
};

}  // namespace towbench::protocol
