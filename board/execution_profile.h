// What the processor has executed: instructions, per function, and per interrupt from the exception
// to the instruction it returns to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "board/block_table.h"
#include "board/elf_image.h"
#include "core/time.h"

namespace towbench::board {

struct InterruptCost {
  std::uint64_t count = 0;
  std::uint64_t instructions = 0;
  std::uint64_t worst = 0;
  core::Nanoseconds worst_at_ns = 0;
};

struct FunctionCost {
  std::uint64_t instructions = 0;
  std::uint64_t in_interrupts = 0;
};

class ExecutionProfile {
 public:
  static constexpr unsigned kInterrupts = 128;

  // Functions are counted by their index in the image's symbols.
  void observe(const ElfImage& image);

  // The block there, which is to be counted with ran(); null when it never ran.
  [[nodiscard]] Block* block_at(std::uint32_t address, std::uint32_t size) noexcept {
    return blocks_.find(address, size);
  }
  // Valid until the next new block.
  Block& new_block(std::uint32_t address, std::uint32_t size, std::uint32_t instructions);
  void ran(Block& block) noexcept {
    instructions_ += block.instructions;
    ++block.runs;
    block.runs_in_interrupts += in_interrupt_;
  }

  void enter(unsigned interrupt, std::uint32_t return_pc, std::uint32_t return_sp,
             core::Nanoseconds now_ns);
  // True when a frame may end at this address: then ask left().
  [[nodiscard]] bool may_leave(std::uint32_t address) const noexcept {
    return address == innermost_pc_ && in_interrupt_ != 0;
  }
  // False: the stack says that it goes on.
  bool left(std::uint32_t sp);
  // The processor starts again: nothing is in an interrupt. What was counted stays.
  void restart() noexcept;
  // The code in memory is another: what its blocks have cost is added up.
  void forget_blocks();

  // Where the stack stood highest when an interrupt was taken; 0 before the first.
  [[nodiscard]] std::uint32_t highest_stack() const noexcept { return highest_stack_; }
  [[nodiscard]] std::uint64_t instructions() const noexcept { return instructions_; }
  [[nodiscard]] const InterruptCost& interrupt(unsigned n) const { return interrupts_[n]; }
  // By symbol of the image.
  [[nodiscard]] std::vector<FunctionCost> functions() const;

 private:
  struct Frame {
    unsigned interrupt = 0;
    std::uint32_t pc = 0;
    std::uint32_t sp = 0;
    std::uint64_t before = 0;
    std::uint64_t nested = 0;  // instructions of interrupts within this one
    core::Nanoseconds time_ns = 0;
  };

  void look_at_innermost() noexcept;

  const ElfImage* image_ = nullptr;
  BlockTable blocks_;
  std::vector<FunctionCost> functions_;  // of blocks that are forgotten
  std::uint32_t innermost_pc_ = 0;       // of the last frame
  std::uint32_t in_interrupt_ = 0;       // 1 within interrupts, else 0
  std::array<InterruptCost, kInterrupts> interrupts_{};
  std::vector<Frame> frames_;
  std::uint64_t instructions_ = 0;
  std::uint32_t highest_stack_ = 0;
};

}  // namespace towbench::board
