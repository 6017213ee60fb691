// Gives a line without a bit rate (a pty, a socket) the rate of a wire: a byte is read no earlier
// than a wire of that rate could have brought it, one after the other.
//
// Pacing sits at the receiving end because that is where time is seen: a burst that the peer hands
// over at once arrives spread over its wire time. The clock and the waiting are injected.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/time.h"
#include "protocol/byte_stream.h"

namespace towbench::protocol {

class WireClock {
 public:
  WireClock() = default;
  WireClock(const WireClock&) = delete;
  WireClock& operator=(const WireClock&) = delete;
  virtual ~WireClock() = default;
  [[nodiscard]] virtual core::Nanoseconds now_ns() noexcept = 0;
  virtual void wait_until(core::Nanoseconds time_ns) noexcept = 0;
};

// The host's monotonic clock.
class HostWireClock final : public WireClock {
 public:
  [[nodiscard]] core::Nanoseconds now_ns() noexcept override;
  void wait_until(core::Nanoseconds time_ns) noexcept override;
};

// When bits that are handed to a wire at some time have all left it.
class WirePacer {
 public:
  explicit WirePacer(std::uint64_t bits_per_second) noexcept : bits_per_second_(bits_per_second) {}

  // The wire is busy with these bits until the time returned; never earlier than before.
  core::Nanoseconds reserve(core::Nanoseconds now_ns, std::uint64_t bits) noexcept;

 private:
  std::uint64_t bits_per_second_;
  core::Nanoseconds busy_until_ns_ = 0;
  std::uint64_t rest_ = 0;  // of the division, so that the rate is exact over any length
};

class PacedStream final : public ByteStream {
 public:
  // All outlive this.
  PacedStream(ByteStream& line, WireClock& clock, std::uint64_t bits_per_second,
              unsigned bits_per_byte) noexcept
      : line_(line), clock_(clock), pacer_(bits_per_second), bits_per_byte_(bits_per_byte) {}

  core::Status write(std::span<const std::byte> bytes) noexcept override {
    return line_.write(bytes);
  }
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override;

 private:
  struct UnderWay {
    std::byte byte;
    core::Nanoseconds arrival_ns;
  };
  static constexpr std::size_t kCapacity = 8192;  // what is more stays in the line's own buffer

  core::Status take_in(core::Nanoseconds timeout_ns) noexcept;
  std::size_t hand_out(std::span<std::byte> into) noexcept;

  ByteStream& line_;
  WireClock& clock_;
  WirePacer pacer_;
  unsigned bits_per_byte_;
  core::Status ended_;
  std::size_t first_ = 0;
  std::size_t held_ = 0;
  std::array<UnderWay, kCapacity> under_way_;
  std::array<std::byte, kCapacity> received_;
};

}  // namespace towbench::protocol
