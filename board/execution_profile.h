// What the processor has executed: instructions, per function, and per interrupt from the exception
// to the instruction it returns to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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

  // A block of so many instructions runs, of the function with that index (-1: none).
  void block(int function, std::uint32_t instructions) noexcept {
    instructions_ += instructions;
    if (function >= 0) {
      FunctionCost& cost = functions_[static_cast<std::size_t>(function)];
      cost.instructions += instructions;
      cost.in_interrupts += frames_.empty() ? 0 : instructions;
    }
  }
  [[nodiscard]] int function_at(std::uint32_t address) const {
    return image_ == nullptr ? -1 : image_->function_at(address);
  }

  void enter(unsigned interrupt, std::uint32_t return_pc, std::uint32_t return_sp,
             core::Nanoseconds now_ns);
  // True when a frame may end at this address: then ask left().
  [[nodiscard]] bool may_leave(std::uint32_t address) const noexcept {
    return !frames_.empty() && frames_.back().pc == address;
  }
  // False: the stack says that it goes on.
  bool left(std::uint32_t sp);
  // The processor starts again: nothing is in an interrupt. What was counted stays.
  void restart() noexcept { frames_.clear(); }

  // Where the stack stood highest when an interrupt was taken; 0 before the first.
  [[nodiscard]] std::uint32_t highest_stack() const noexcept { return highest_stack_; }
  [[nodiscard]] std::uint64_t instructions() const noexcept { return instructions_; }
  [[nodiscard]] const InterruptCost& interrupt(unsigned n) const { return interrupts_[n]; }
  [[nodiscard]] const std::vector<FunctionCost>& functions() const noexcept { return functions_; }

 private:
  struct Frame {
    unsigned interrupt = 0;
    std::uint32_t pc = 0;
    std::uint32_t sp = 0;
    std::uint64_t before = 0;
    std::uint64_t nested = 0;  // instructions of interrupts within this one
    core::Nanoseconds time_ns = 0;
  };

  const ElfImage* image_ = nullptr;
  std::vector<FunctionCost> functions_;
  std::array<InterruptCost, kInterrupts> interrupts_{};
  std::vector<Frame> frames_;
  std::uint64_t instructions_ = 0;
  std::uint32_t highest_stack_ = 0;
};

}  // namespace towbench::board
