#include "board/execution_profile.h"

namespace towbench::board {

void ExecutionProfile::observe(const ElfImage& image) {
  image_ = &image;
  functions_.assign(image.symbols().size(), {});
  frames_.clear();
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
}

bool ExecutionProfile::left(std::uint32_t sp) {
  const Frame frame = frames_.back();
  if (frame.sp != sp) {
    return false;
  }
  frames_.pop_back();
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
