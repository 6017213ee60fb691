#include "board/execution_profile.h"

namespace towbench::board {

void ExecutionProfile::observe(const ElfImage& image) {
  image_ = &image;
  functions_.assign(image.symbols().size(), {});
  blocks_.clear();
  restart();
}

Block& ExecutionProfile::new_block(std::uint32_t address, std::uint32_t size,
                                   std::uint32_t instructions) {
  return blocks_.add({.address = address,
                      .size = size,
                      .instructions = instructions,
                      .function = image_ == nullptr ? -1 : image_->function_at(address)});
}

std::vector<FunctionCost> ExecutionProfile::functions() const {
  auto costs = functions_;
  for (const Block& block : blocks_.blocks()) {
    if (block.function >= 0) {
      FunctionCost& cost = costs[static_cast<std::size_t>(block.function)];
      cost.instructions += block.runs * block.instructions;
      cost.in_interrupts += block.runs_in_interrupts * block.instructions;
    }
  }
  return costs;
}

void ExecutionProfile::forget_blocks() {
  functions_ = functions();
  blocks_.clear();
}

void ExecutionProfile::restart() noexcept {
  frames_.clear();
  look_at_innermost();
}

void ExecutionProfile::look_at_innermost() noexcept {
  in_interrupt_ = frames_.empty() ? 0 : 1;
  innermost_pc_ = frames_.empty() ? 0 : frames_.back().pc;
}

void ExecutionProfile::enter(unsigned interrupt, std::uint32_t return_pc, std::uint32_t return_sp,
                             core::Nanoseconds now_ns) {
  // A program that never returns from its interrupts (a scheduler that switches stacks) would
  // collect frames for ever.
  constexpr std::size_t kDeepest = 64;
  if (frames_.size() == kDeepest) {
    frames_.clear();
  }
  highest_stack_ = return_sp > highest_stack_ ? return_sp : highest_stack_;
  frames_.push_back({interrupt % kInterrupts, return_pc, return_sp, instructions_, 0, now_ns});
  look_at_innermost();
}

bool ExecutionProfile::left(std::uint32_t sp) {
  const Frame frame = frames_.back();
  if (frame.sp != sp) {
    return false;
  }
  frames_.pop_back();
  look_at_innermost();
  const std::uint64_t all = instructions_ - frame.before;
  const std::uint64_t own = all - frame.nested;
  if (!frames_.empty()) {
    frames_.back().nested += all;
  }
  InterruptCost& cost = interrupts_[frame.interrupt];
  ++cost.count;
  cost.instructions += own;
  if (own > cost.worst) {
    cost.worst = own;
    cost.worst_at_ns = frame.time_ns;
  }
  return true;
}

}  // namespace towbench::board
