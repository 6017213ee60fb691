// Framing for a line that loses and invents bytes (serial): consistent overhead byte stuffing
// (Cheshire and Baker, IEEE/ACM Transactions on Networking 7(2), 1999):
//   COBS(payload | CRC-32C u32 over the payload) | 0x00
// No byte but the last of a frame is zero, so a reader that lost its place is back at the next
// zero: damage costs the frame it hits and, if it hits the zero, the one after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/codec.h"
#include "protocol/crc.h"
#include "protocol/link_counts.h"
#include "protocol/stream_writer.h"
#include "protocol/wire.h"

namespace towbench::protocol {

// Bytes that stuffing adds to `size` bytes at most, without the closing zero.
[[nodiscard]] constexpr std::size_t cobs_overhead(std::size_t size) noexcept {
  return 1 + size / 254;
}

// Stuffs `bytes` into `into`, which has room for size + cobs_overhead(size), and returns the size
// written. No zero is written.
std::size_t cobs_stuff(std::span<const std::byte> bytes, std::span<std::byte> into) noexcept;

// Unstuffs in place and returns the size; 0 when the bytes are not COBS (or hold nothing).
std::size_t cobs_unstuff(std::span<std::byte> bytes) noexcept;

struct CobsFraming {
  static constexpr std::size_t kMaxBodySize = kMaxPayloadSize + kCrcSize;
  static constexpr std::size_t kMaxFrameSize = kMaxBodySize + cobs_overhead(kMaxBodySize) + 1;

  template <typename Message>
  static std::size_t append(const Message& message, std::span<std::byte> into) noexcept {
    std::array<std::byte, kMaxBodySize> body;
    const std::size_t size = encode(message, body);
    return close(body, size, into);
  }

 private:
  // Adds the checksum, stuffs and delimits.
  static std::size_t close(std::span<std::byte> body, std::size_t payload_size,
                           std::span<std::byte> into) noexcept;
};

using CobsWriter = StreamWriter<CobsFraming>;

class CobsReader {
 public:
  // Any bytes in any portions; the sink is called for each message in order. Not re-entrant.
  TOWBENCH_REALTIME void feed(std::span<const std::byte> bytes, MessageSink& sink) noexcept;

  // The stream has ended: what is left over is a truncated frame.
  void finish(MessageSink& sink) noexcept;

  [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }

 private:
  void take(std::span<const std::byte> bytes) noexcept;
  void close_frame(MessageSink& sink) noexcept;

  LinkCounts counts_;
  bool overflowed_ = false;
  std::size_t held_ = 0;
  Decoder decoder_;
  std::array<std::byte, CobsFraming::kMaxFrameSize> buffer_;
};

}  // namespace towbench::protocol
