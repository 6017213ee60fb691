// Framing for a byte stream that loses nothing (a local socket):
//   length u16 | payload | CRC-32C u32 over length and payload
// Nothing is escaped, so a reader that lost its place steps on byte by byte to the next header that
// can be one (length and message id agree) and whose checksum holds. A false header may hold back
// up to one frame's length of good data; lines that do lose bytes use COBS (cobs.h).
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

inline constexpr std::size_t kFrameHeaderSize = 2;
inline constexpr std::size_t kFrameOverhead = kFrameHeaderSize + kCrcSize;

struct LengthFraming {
  static constexpr std::size_t kMaxFrameSize = kMaxPayloadSize + kFrameOverhead;

  template <typename Message>
  static std::size_t append(const Message& message, std::span<std::byte> into) noexcept {
    if (into.size() < kFrameOverhead) {
      return 0;
    }
    const std::size_t size = encode(message, into.subspan(kFrameHeaderSize));
    if (size == 0 || size + kFrameOverhead > into.size()) {
      return 0;
    }
    store_little_endian(into.data(), static_cast<std::uint16_t>(size));
    const std::size_t covered = kFrameHeaderSize + size;
    store_little_endian(into.data() + covered, crc32c(into.first(covered)));
    return covered + kCrcSize;
  }
};

using FrameWriter = StreamWriter<LengthFraming>;

class FrameReader {
 public:
  // Any bytes in any portions; the sink is called for each message in order. Not re-entrant: the
  // sink must not feed this reader.
  TOWBENCH_REALTIME void feed(std::span<const std::byte> bytes, MessageSink& sink) noexcept;

  // The stream has ended: what is left over is a truncated frame, or whole ones that a false header
  // held back.
  void finish(MessageSink& sink) noexcept;

  [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }

 private:
  // Delivers what is whole and returns how many bytes are done with.
  std::size_t consume(std::span<const std::byte> bytes, MessageSink& sink) noexcept;
  void deliver(std::span<const std::byte> payload, MessageSink& sink) noexcept;
  void lose_place(std::uint64_t& reason) noexcept;

  LinkCounts counts_;
  bool in_place_ = true;
  std::size_t held_ = 0;
  Decoder decoder_;
  std::array<std::byte, 2 * LengthFraming::kMaxFrameSize> buffer_;
};

}  // namespace towbench::protocol
