// A message that does not fit into one frame, over several:
//   length u8 | payload | CRC-32C u32 over both | zeros to the end of the last frame
// seven bytes a frame, each frame behind one byte: bit 7 set in the first, bits 0-6 how many frames
// follow this one. A message that lost a frame is dropped and counted; the next first frame starts
// afresh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/carriers/can_frame.h"
#include "protocol/crc.h"
#include "protocol/link_counts.h"

namespace towbench::protocol {

inline constexpr std::size_t kCanSegmentSize = kCanDataSize - 1;
inline constexpr std::size_t kMaxSegmentedPayload = 255;

// Frames that a payload of this size takes.
[[nodiscard]] constexpr std::size_t segments_of(std::size_t payload_size) noexcept {
  return (1 + payload_size + kCrcSize + kCanSegmentSize - 1) / kCanSegmentSize;
}

// Sends `payload` under `id`. False, and nothing sent, when it is too long.
bool send_segmented(std::span<const std::byte> payload, std::uint32_t id,
                    CanFrameSink& out) noexcept;

// Puts the frames of one identifier together again.
class CanReassembler {
 public:
  // The payload when this frame completes it, else empty. Valid until the next call.
  [[nodiscard]] std::span<const std::byte> take(const CanFrame& frame, LinkCounts& counts) noexcept;

 private:
  std::size_t following_ = 0;  // frames still to come
  std::size_t held_ = 0;
  std::array<std::byte, segments_of(kMaxSegmentedPayload) * kCanSegmentSize> bytes_;
};

}  // namespace towbench::protocol
