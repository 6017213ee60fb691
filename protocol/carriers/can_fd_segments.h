// A long message over CAN FD frames, as can_segments.h does it over classic ones:
//   length u16 | payload | CRC-32C u32 over both | zeros to the end of the last frame
// 63 bytes a frame, each frame behind one byte: bit 7 set in the first, bits 0-6 how many frames
// follow this one. All have 64 bytes but the last, which has the smallest size that holds the rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/carriers/can_frame.h"
#include "protocol/codec.h"
#include "protocol/crc.h"
#include "protocol/link_counts.h"

namespace towbench::protocol {

inline constexpr std::size_t kCanFdSegmentSize = kCanFdDataSize - 1;
inline constexpr std::size_t kFdSegmentOverhead = 2 + kCrcSize;

// Frames that a payload of this size takes.
[[nodiscard]] constexpr std::size_t fd_segments_of(std::size_t payload_size) noexcept {
  return (kFdSegmentOverhead + payload_size + kCanFdSegmentSize - 1) / kCanFdSegmentSize;
}
static_assert(fd_segments_of(kMaxPayloadSize) <= 128);

// Data bytes of the last of them.
[[nodiscard]] constexpr std::size_t last_fd_segment_of(std::size_t payload_size) noexcept {
  const std::size_t before = (fd_segments_of(payload_size) - 1) * kCanFdSegmentSize;
  return can_fd_size(1 + kFdSegmentOverhead + payload_size - before);
}

// Sends `payload` under `id`. False, and nothing sent, when it is empty or longer than any message.
bool send_fd_segmented(std::span<const std::byte> payload, std::uint32_t id,
                       CanFrameSink& out) noexcept;

// Puts the frames of one identifier together again. A message that lost a frame is dropped and
// counted; the next first frame starts afresh.
class CanFdReassembler {
 public:
  // The payload when this frame completes it, else empty. Valid until the next call.
  [[nodiscard]] std::span<const std::byte> take(const CanFrame& frame, LinkCounts& counts) noexcept;

 private:
  [[nodiscard]] std::span<const std::byte> whole(LinkCounts& counts) const noexcept;

  std::size_t following_ = 0;  // frames still to come
  std::size_t held_ = 0;
  std::array<std::byte, fd_segments_of(kMaxPayloadSize) * kCanFdSegmentSize> bytes_;
};

}  // namespace towbench::protocol
