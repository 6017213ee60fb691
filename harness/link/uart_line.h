// A serial line whose two ends disagree about the baud rate, bit by bit.
#pragma once

#include <cstddef>
#include <span>

namespace towbench::harness {

// What a UART (8N1: start bit 0, eight bits from the lowest, stop bit 1, the line idles at 1) that
// samples in the middle of its own bits makes of bytes that another sends back to back.
// `rate_ratio` is the receiver's baud rate over the sender's. A byte whose stop bit is no 1 is a
// framing error and is dropped; up to a twentieth off every byte arrives (half a bit in 9.5).
// Returns how many bytes were received; as many as fit into `received`.
[[nodiscard]] std::size_t over_uart(std::span<const std::byte> sent, double rate_ratio,
                                    std::span<std::byte> received) noexcept;

}  // namespace towbench::harness
