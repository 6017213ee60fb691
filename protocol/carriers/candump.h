// Lines of can-utils' `candump -L`, which canplayer sends again and log2asc reads:
//   (1436509052.249713) vcan0 190#8F2A366C2BBA0102
//   (1436509052.249713) vcan0 1A0##18F2A36       an FD frame: its flags (1 rate switched), its data
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/time.h"
#include "protocol/carriers/can_frame.h"

namespace towbench::protocol {

struct CandumpLine {
  core::Nanoseconds time_ns = 0;  // whole microseconds
  std::string_view interface;     // into the text that was read
  CanFrame frame{};
};

// Room for any line: 15 characters of interface name, the largest time.
inline constexpr std::size_t kMaxCandumpLine = 200;

// Without a line end. Empty when `into` is too small, the time negative, or the interface name not
// one (1 to 15 characters, no space). The time is rounded down to microseconds.
[[nodiscard]] std::string_view write_candump(const CandumpLine& line,
                                             std::span<char> into) noexcept;

// Nothing for a line that is no data frame with an 11-bit identifier: remote (`#R`), extended
// identifiers (eight digits, error frames among them), or no candump line at all. The flags of an
// FD frame are not kept.
// Whatever follows the data (`candump -Lx` adds T or R) is ignored.
[[nodiscard]] std::optional<CandumpLine> read_candump(std::string_view text) noexcept;

}  // namespace towbench::protocol
