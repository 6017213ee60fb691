// How many Thumb instructions a block of code holds: an instruction is one halfword, or two when
// the first five bits are 0b11101, 0b11110 or 0b11111 (ARM ARM A6.1).
#pragma once

#include <cstdint>

namespace towbench::board {

// Bytes of the instruction whose first halfword is the lower one of `code`.
[[nodiscard]] constexpr std::uint32_t thumb_size(std::uint32_t code) noexcept {
  return (code >> 11U & 0x1FU) >= 0x1DU ? 4U : 2U;
}

// `read` gives the 32-bit word at any even address.
template <typename Read>
[[nodiscard]] std::uint32_t thumb_instructions(std::uint32_t address, std::uint32_t size,
                                               Read read) {
  std::uint32_t count = 0;
  for (std::uint32_t at = address; at < address + size; ++count) {
    at += thumb_size(read(at));
  }
  return count;
}

}  // namespace towbench::board
