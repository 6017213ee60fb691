#include "board/faulting_instruction.h"

namespace towbench::board {
namespace {

// How far a transfer of many registers may reach from its base.
constexpr std::uint32_t kMultipleReach = 64;

bool is_near(std::uint32_t accessed, std::uint32_t base) noexcept {
  return accessed - base < kMultipleReach || base - accessed <= kMultipleReach;
}

}  // namespace

bool arm_accesses(std::uint32_t code, const RegisterSet& set, std::uint32_t accessed) noexcept {
  const std::uint32_t base_register = code >> 16U & 0xFU;
  if (base_register == 15) {
    return false;
  }
  const std::uint32_t base = set[base_register];
  const bool before = (code & 1U << 24U) != 0;
  const bool up = (code & 1U << 23U) != 0;
  const auto with = [&](std::uint32_t offset) {
    return !before ? base : up ? base + offset : base - offset;
  };
  if ((code & 0x0E00'0000U) == 0x0400'0000U) {  // word or byte, immediate
    return with(code & 0xFFFU) == accessed;
  }
  if ((code & 0x0E00'0010U) == 0x0600'0000U) {  // word or byte, register shifted left
    return with(set[code & 0xFU] << (code >> 7U & 0x1FU)) == accessed;
  }
  if ((code & 0x0E40'0090U) == 0x0040'0090U) {  // halfword, doubleword
    return with((code >> 4U & 0xF0U) | (code & 0xFU)) == accessed;
  }
  if ((code & 0x0E00'0E00U) == 0x0C00'0A00U) {  // VFP
    return with(4 * (code & 0xFFU)) == accessed;
  }
  return (code & 0x0E00'0000U) == 0x0800'0000U && is_near(accessed, base);  // many
}

bool thumb_accesses(std::uint32_t code, const RegisterSet& set, std::uint32_t accessed) noexcept {
  if (thumb_size(code) == 2) {
    const std::uint32_t base = set[code >> 3U & 7U];
    const std::uint32_t five = code >> 6U & 0x1FU;
    switch (code >> 12U & 0xFU) {
      case 5:  // register offset
        return base + set[code >> 6U & 7U] == accessed;
      case 6:  // word
        return base + 4 * five == accessed;
      case 7:  // byte
        return base + five == accessed;
      case 8:  // halfword
        return base + 2 * five == accessed;
      case 9:  // of the stack
        return set[13] + 4 * (code & 0xFFU) == accessed;
      case 11:  // push, pop
        return (code & 0xF600U) == 0xB400U && is_near(accessed, set[13]);
      case 12:  // many
        return is_near(accessed, set[code >> 8U & 7U]);
      default:
        return false;
    }
  }
  const std::uint32_t base = set[code & 0xFU];
  const std::uint32_t second = code >> 16U;
  if ((code & 0xFE00U) == 0xF800U) {  // single
    if ((code & 0x80U) != 0) {
      return base + (second & 0xFFFU) == accessed;
    }
    if ((second & 0x800U) != 0) {
      const bool before = (second & 0x400U) != 0;
      const bool up = (second & 0x200U) != 0;
      const std::uint32_t offset = second & 0xFFU;
      return (!before ? base : up ? base + offset : base - offset) == accessed;
    }
    return base + (set[second & 0xFU] << (second >> 4U & 3U)) == accessed;
  }
  const bool is_double = (code & 0xFE40U) == 0xE840U;
  const bool is_vfp = (code & 0xFE00U) == 0xEC00U;
  if (is_double || is_vfp) {
    const std::uint32_t offset = 4 * (second & 0xFFU);
    const bool before = (code & 0x100U) != 0;
    return (!before ? base : (code & 0x80U) != 0 ? base + offset : base - offset) == accessed;
  }
  return (code & 0xFE40U) == 0xE800U && is_near(accessed, base);  // many
}

}  // namespace towbench::board
