// CRC-32C (Castagnoli): polynomial 0x1EDC6F41 reflected, initial value and final xor 0xFFFFFFFF.
// Detects every burst up to 32 bits and, below 655 bytes, every error of up to 5 bits (Koopman,
// "32-Bit Cyclic Redundancy Codes for Internet Applications", DSN 2002, table 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/realtime.h"

namespace towbench::protocol {

inline constexpr std::size_t kCrcSize = 4;

[[nodiscard]] TOWBENCH_REALTIME std::uint32_t crc32c(std::span<const std::byte> bytes) noexcept;

// The portable form of the same, whatever the processor offers: for tests and benchmarks.
[[nodiscard]] std::uint32_t crc32c_by_table(std::span<const std::byte> bytes) noexcept;

}  // namespace towbench::protocol
