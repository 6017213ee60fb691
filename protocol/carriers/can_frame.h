// A CAN frame with an 11-bit identifier, classic or FD, and where frames go.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace towbench::protocol {

inline constexpr std::size_t kCanDataSize = 8;     // of a classic frame
inline constexpr std::size_t kCanFdDataSize = 64;  // of an FD frame
inline constexpr std::uint32_t kMaxStandardId = 0x7ff;

struct CanFrame {
  std::uint32_t id = 0;
  std::uint8_t size = 0;  // <= kCanDataSize; of an FD frame one of can_fd_size()'s
  std::array<std::uint8_t, kCanFdDataSize> data{};
  bool is_fd = false;

  [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return {data.data(), size}; }
  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

class CanFrameSink {
 public:
  CanFrameSink() = default;
  CanFrameSink(const CanFrameSink&) = delete;
  CanFrameSink& operator=(const CanFrameSink&) = delete;
  virtual ~CanFrameSink() = default;
  virtual void on(const CanFrame& frame) noexcept = 0;
};

// Bits on the wire, interframe space included, with the worst possible stuffing: 34 + 8 n bits are
// stuffed, one bit for each four after the first (ISO 11898-1; Davis et al., "Controller Area
// Network (CAN) schedulability analysis", Real-Time Systems 35, 2007, equation 1).
[[nodiscard]] constexpr unsigned worst_can_bits(unsigned data_bytes) noexcept {
  return 47 + 8 * data_bytes + (34 + 8 * data_bytes - 1) / 4;
}

// The smallest size that an FD frame can have with so many data bytes (ISO 11898-1:2015, DLC).
[[nodiscard]] constexpr std::size_t can_fd_size(std::size_t data_bytes) noexcept {
  for (const std::size_t size : {12U, 16U, 20U, 24U, 32U, 48U}) {
    if (data_bytes <= size) {
      return data_bytes <= kCanDataSize ? data_bytes : size;
    }
  }
  return kCanFdDataSize;
}

// Bits of an FD frame at each of its two rates.
struct CanFdBits {
  unsigned nominal = 0;
  unsigned data = 0;
};

// The same for an FD frame that switches its rate (ISO 11898-1:2015, 10.4.2). At the nominal rate
// 17 bits up to the switch, stuffed, and 13 behind the checksum (delimiter, acknowledge, end,
// interframe space); between them five bits and the data, stuffed, then stuff count and checksum of
// 4 + 17 bits, 4 + 21 above 16 bytes, with a fixed stuff bit in front and behind each four.
[[nodiscard]] constexpr CanFdBits worst_can_fd_bits(unsigned data_bytes) noexcept {
  constexpr unsigned kHead = 17;
  constexpr unsigned kTail = 13;
  const unsigned stuffed = 5 + 8 * data_bytes;
  const unsigned checked = data_bytes > 16 ? 25 : 21;
  return {.nominal = kHead + (kHead - 1) / 4 + kTail,
          .data = stuffed + stuffed / 4 + checked + 1 + checked / 4};
}

}  // namespace towbench::protocol
