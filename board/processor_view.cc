// What can be seen of the processor from outside: registers, the stack, the code that runs.
#include <algorithm>
#include <array>

#include <unicorn/unicorn.h>

#include "board/faulting_instruction.h"
#include "board/processor.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kThumbBit = 1U << 5U;

}  // namespace

std::uint32_t Processor::reg(int id) const {
  std::uint32_t value = 0;
  uc_reg_read(engine_, id, &value);
  return value;
}

RegisterSet Processor::registers() const {
  constexpr std::array kIds{UC_ARM_REG_R0,  UC_ARM_REG_R1,  UC_ARM_REG_R2,  UC_ARM_REG_R3,
                            UC_ARM_REG_R4,  UC_ARM_REG_R5,  UC_ARM_REG_R6,  UC_ARM_REG_R7,
                            UC_ARM_REG_R8,  UC_ARM_REG_R9,  UC_ARM_REG_R10, UC_ARM_REG_R11,
                            UC_ARM_REG_R12, UC_ARM_REG_R13, UC_ARM_REG_R14, UC_ARM_REG_CPSR};
  RegisterSet set{};
  for (std::size_t i = 0; i < kIds.size(); ++i) {
    set[i] = reg(kIds[i]);
  }
  return set;
}

FloatRegisters Processor::float_registers() const {
  FloatRegisters set{};
  for (int i = 0; i < 32; ++i) {
    uc_reg_read(engine_, UC_ARM_REG_D0 + i, &set[static_cast<std::size_t>(i)]);
  }
  set[32] = reg(UC_ARM_REG_FPSCR);
  return set;
}

std::uint32_t Processor::code_word(std::uint32_t address) const {
  std::uint32_t word = 0;
  uc_mem_read(engine_, address, &word, sizeof word);
  return word;
}

// Unicorn knows the block only.
std::uint32_t Processor::instruction_that_accesses(std::uint32_t address) const {
  const bool thumb = (reg(UC_ARM_REG_CPSR) & kThumbBit) != 0;
  return faulting_instruction({block_, block_size_, thumb}, registers(), address,
                              [this](std::uint32_t at) { return code_word(at); });
}

std::span<const std::uint8_t> Processor::stack_top() const {
  constexpr std::uint32_t kLooked = 512;
  const std::uint32_t sp = stack_pointer();
  for (const Memory& memory : memories_) {
    const std::uint32_t into = sp - memory.address;
    if (sp >= memory.address && into < memory.bytes.size()) {
      return memory.bytes.subspan(into, std::min<std::size_t>(kLooked, memory.bytes.size() - into));
    }
  }
  return {};
}

}  // namespace towbench::board
