// A classic CAN frame with an 11-bit identifier, and where frames go.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace towbench::protocol {

inline constexpr std::size_t kCanDataSize = 8;
inline constexpr std::uint32_t kMaxStandardId = 0x7ff;

struct CanFrame {
  std::uint32_t id = 0;
  std::uint8_t size = 0;  // <= kCanDataSize
  std::array<std::uint8_t, kCanDataSize> data{};

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

}  // namespace towbench::protocol
