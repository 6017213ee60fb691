// Which instruction of a block of code made an access, found from the address and the registers:
// the CPU emulator tells the block alone.
#pragma once

#include <cstdint>

#include "board/idle_detector.h"
#include "board/thumb_length.h"

namespace towbench::board {

struct CodeBlock {
  std::uint32_t address = 0;
  std::uint32_t size = 0;  // bytes
  bool thumb = false;
};

// Whether this instruction accesses that address.
[[nodiscard]] bool arm_accesses(std::uint32_t code, const RegisterSet& set,
                                std::uint32_t accessed) noexcept;
// `code`: first halfword below, second above.
[[nodiscard]] bool thumb_accesses(std::uint32_t code, const RegisterSet& set,
                                  std::uint32_t accessed) noexcept;

// The first instruction of the block whose base register and offset make `accessed`; registers are
// as they were just before it. The block's start when none does.
template <typename ReadWord>
[[nodiscard]] std::uint32_t faulting_instruction(const CodeBlock& block, const RegisterSet& set,
                                                 std::uint32_t accessed, ReadWord word_at) {
  std::uint32_t step = 4;
  for (std::uint32_t at = block.address; at < block.address + block.size; at += step) {
    const std::uint32_t code = word_at(at);
    step = block.thumb ? thumb_size(code) : 4;
    if (block.thumb ? thumb_accesses(code, set, accessed) : arm_accesses(code, set, accessed)) {
      return at;
    }
  }
  return block.address;
}

}  // namespace towbench::board
