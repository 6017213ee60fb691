// Carries the faults of an experiment's board out on it, and tells afterwards what each has done.
#pragma once

#include <cstdint>
#include <vector>

#include "board/board.h"
#include "harness/checks/check.h"
#include "harness/experiment/board_plan.h"

namespace towbench::harness {

class BoardFaults {
 public:
  // The board outlives this.
  BoardFaults(const std::vector<BoardFault>& plan, board::Board& board);

  // What is due at `now_ns`. True when the board has been switched on again: the image starts over.
  [[nodiscard]] bool act(core::Nanoseconds now_ns);

  // One each: INVALID when it had no effect on what the image executed or read.
  [[nodiscard]] std::vector<Check> checks() const;

 private:
  struct Running {
    BoardFault fault;
    core::Nanoseconds at_ns = 0;
    core::Nanoseconds until_ns = 0;
    enum class State : std::uint8_t { kAhead, kActive, kOver } state = State::kAhead;
    std::uint64_t before = 0;  // of its counter, when it began
  };

  void begin(Running& running);
  // True when the board starts again.
  bool end(Running& running);
  void stick_again();
  [[nodiscard]] std::uint64_t counter_of(const Running& running) const;

  board::Board& board_;
  std::vector<Running> running_;
};

}  // namespace towbench::harness
