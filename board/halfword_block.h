// A register window of 16-bit registers (eQEP, eHRPWM): a word access reaches two of them.
#pragma once

#include "board/register_block.h"

namespace towbench::board {

class HalfwordBlock : public RegisterBlock {
 public:
  using RegisterBlock::RegisterBlock;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override {
    std::uint32_t value = (lanes & 0xFFFFU) != 0 ? read_half(offset) : 0U;
    if ((lanes >> 16U) != 0) {
      value |= static_cast<std::uint32_t>(read_half(offset + 2)) << 16U;
    }
    return value;
  }
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override {
    const auto low = static_cast<std::uint16_t>(lanes);
    const auto high = static_cast<std::uint16_t>(lanes >> 16U);
    if (low != 0) {
      write_half(offset, static_cast<std::uint16_t>(value), low);
    }
    if (high != 0) {
      write_half(offset + 2, static_cast<std::uint16_t>(value >> 16U), high);
    }
  }

  [[nodiscard]] virtual std::uint16_t read_half(std::uint32_t offset) = 0;
  virtual void write_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) = 0;

  [[nodiscard]] std::uint16_t half(std::uint32_t offset) const {
    return static_cast<std::uint16_t>(stored(offset - offset % 4) >> (8 * (offset % 4)));
  }
  void keep_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) {
    const unsigned shift = 8 * (offset % 4);
    keep(offset - offset % 4, static_cast<std::uint32_t>(value) << shift,
         static_cast<std::uint32_t>(lanes) << shift);
  }
};

}  // namespace towbench::board
