// Identifiers and bit layout of the packed frames. protocol/macs.dbc says the same; a test reads it
// and compares.
//
// The lower an identifier, the earlier it wins the bus: end of the run and faults, then lines, then
// duty, then the digest or the edges, then lockstep, then everything long.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "protocol/carriers/can_frame.h"

namespace towbench::protocol {

enum class CanDirection : std::uint8_t { kToPlant = 0, kToController = 1 };

namespace can_id {

// + the direction.
inline constexpr std::uint32_t kFault = 0x040;
inline constexpr std::uint32_t kBye = 0x050;
inline constexpr std::uint32_t kLines = 0x080;
// + the axis.
inline constexpr std::uint32_t kDuty = 0x100;
inline constexpr std::uint32_t kIndex = 0x180;
inline constexpr std::uint32_t kDigest = 0x190;
inline constexpr std::uint32_t kEdges = 0x1a0;  // FD frames
// + the direction: Advance goes to the plant, Advanced to the controller.
inline constexpr std::uint32_t kLockstep = 0x200;
inline constexpr std::uint32_t kLong = 0x600;
inline constexpr std::uint32_t kHeartbeat = 0x700;

}  // namespace can_id

// Bits [first, first + width) of the frame's data, taken as one little-endian 64-bit word.
struct BitField {
  unsigned first;
  unsigned width;

  [[nodiscard]] constexpr std::uint64_t mask() const noexcept {
    return width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1U;
  }
  [[nodiscard]] constexpr bool fits(std::uint64_t value) const noexcept { return value <= mask(); }
  // Whatever does not fit is cut off.
  [[nodiscard]] constexpr std::uint64_t put(std::uint64_t value) const noexcept {
    return (value & mask()) << first;
  }
  [[nodiscard]] constexpr std::uint64_t get(std::uint64_t word) const noexcept {
    return (word >> first) & mask();
  }
  [[nodiscard]] constexpr std::int64_t get_signed(std::uint64_t word) const noexcept {
    const std::uint64_t sign = std::uint64_t{1} << (width - 1);
    return static_cast<std::int64_t>((get(word) ^ sign) - sign);
  }
};

namespace can_bits {

inline constexpr BitField kDutyChannelA{0, 16};
inline constexpr BitField kDutyChannelB{16, 16};
inline constexpr BitField kDutyPeriod{32, 16};
inline constexpr BitField kDutyEnable{48, 1};
inline constexpr BitField kDutySequence{49, 15};

inline constexpr BitField kDigestCountChange{0, 12};
inline constexpr BitField kDigestLevels{12, 3};
inline constexpr BitField kDigestEdges{15, 2};  // 0 none, 1 one, 2 several
inline constexpr BitField kDigestIndexFollowed{17, 1};
inline constexpr BitField kDigestSequence{18, 6};
inline constexpr BitField kDigestLastEdgeAge_ns{24, 20};
inline constexpr BitField kDigestCapturePeriod_ns{44, 20};

inline constexpr BitField kIndexCount{0, 32};
inline constexpr BitField kIndexPulses{32, 16};
inline constexpr BitField kIndexSequence{48, 16};

inline constexpr BitField kLinesLevels{0, 8};
inline constexpr BitField kLinesSequence{8, 8};
inline constexpr BitField kLinesChange_ns{16, 48};

inline constexpr BitField kHeartbeatSequence{0, 16};
inline constexpr BitField kHeartbeatTime_ns{16, 48};

inline constexpr BitField kTime_ns{0, 64};  // Advance, Advanced, Bye

}  // namespace can_bits

[[nodiscard]] constexpr CanFrame can_frame(std::uint32_t id, std::uint64_t word) noexcept {
  CanFrame frame{.id = id, .size = kCanDataSize};
  for (unsigned i = 0; i < kCanDataSize; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(word >> (8U * i));
  }
  return frame;
}

[[nodiscard]] constexpr std::uint64_t word_of(const CanFrame& frame) noexcept {
  std::uint64_t word = 0;
  for (unsigned i = 0; i < frame.size; ++i) {
    word |= std::uint64_t{frame.data[i]} << (8U * i);
  }
  return word;
}

// The first number after `last` whose low bits are `low`.
[[nodiscard]] constexpr std::uint32_t next_sequence(std::uint32_t last, std::uint64_t low,
                                                    BitField field) noexcept {
  const std::uint32_t next = last + 1U;
  const auto step = static_cast<std::uint32_t>((low - next) & field.mask());
  return next + step;
}

}  // namespace towbench::protocol
