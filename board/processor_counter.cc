// The instructions that reach the cycle counter. Unicorn executes them, with a counter that stands:
// before each of them its count is put right, and what it writes is noted.
#include <array>
#include <stdexcept>

#include <unicorn/unicorn.h>

#include "board/processor.h"
#include "board/thumb_length.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kThumbState = 1U << 5U;
constexpr std::array kTargets{UC_ARM_REG_R0,  UC_ARM_REG_R1,  UC_ARM_REG_R2,  UC_ARM_REG_R3,
                              UC_ARM_REG_R4,  UC_ARM_REG_R5,  UC_ARM_REG_R6,  UC_ARM_REG_R7,
                              UC_ARM_REG_R8,  UC_ARM_REG_R9,  UC_ARM_REG_R10, UC_ARM_REG_R11,
                              UC_ARM_REG_R12, UC_ARM_REG_R13, UC_ARM_REG_R14, UC_ARM_REG_R15};

void set_count(uc_engine* engine, std::uint32_t count) {
  uc_arm_cp_reg counter{};
  counter.cp = 15;
  counter.crn = 9;
  counter.crm = 13;
  counter.val = count;
  uc_reg_write(engine, UC_ARM_REG_CP_REG, &counter);
}

void before_instruction(uc_engine* /*uc*/, std::uint64_t address, std::uint32_t /*size*/,
                        void* processor) {
  static_cast<Processor*>(processor)->on_monitor_access(static_cast<std::uint32_t>(address));
}

}  // namespace

std::uint32_t Processor::instruction_at(std::uint32_t address, bool thumb) const {
  const std::uint32_t word = code_word(address);
  return thumb ? word << 16U | word >> 16U : word;
}

bool Processor::find_monitor_accesses(std::uint32_t address, std::uint32_t size, bool thumb) {
  bool found = false;
  for (std::uint32_t at = address; at < address + size;) {
    const std::uint32_t length = thumb ? thumb_size(code_word(at)) : 4;
    if (length == 4 && monitor_access(instruction_at(at, thumb)) && watched_.insert(at).second) {
      uc_hook hook{};
      // Unicorn takes every kind of hook as an untyped pointer.
      auto* function = reinterpret_cast<void*>(&before_instruction);  // NOLINT
      if (uc_hook_add(engine_, &hook, UC_HOOK_CODE, function, this, at, at) != UC_ERR_OK) {
        throw std::runtime_error("unicorn: hook of an instruction");
      }
      found = true;
    }
    at += length;
  }
  return found;
}

void Processor::on_monitor_access(std::uint32_t address) {
  const bool thumb = (reg(UC_ARM_REG_CPSR) & kThumbState) != 0;
  const auto access = monitor_access(instruction_at(address, thumb));
  if (!access || paused_) {
    return;
  }
  // The whole block's time has been counted at its beginning.
  const auto behind = [&](std::uint32_t from) {
    const std::uint32_t size = block_ + block_size_ - from;
    const auto read = [this](std::uint32_t at) { return code_word(at); };
    return thumb ? thumb_instructions(from, size, read) : size / 4;
  };
  const core::Nanoseconds now_ns = bus_.now_ns - kInstruction_ns * behind(address);
  if (!access->reads) {
    counter_.write(*access, reg(kTargets[access->target]), now_ns);
  }
  set_count(engine_, counter_.count(now_ns));
  if (const auto what = CycleCounter::not_modelled(*access); !what.empty() && bus_.doubt.empty()) {
    bus_.doubt = std::string(what) + " of the performance monitor";
    doubtful_pc_ = address;
  }
}

}  // namespace towbench::board
