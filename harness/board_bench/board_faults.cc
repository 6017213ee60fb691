#include "harness/board_bench/board_faults.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

using Kind = BoardFault::Kind;

}  // namespace

BoardFaults::BoardFaults(const std::vector<BoardFault>& plan, board::Board& board) : board_(board) {
  for (const BoardFault& fault : plan) {
    const auto at_ns = core::nanoseconds(fault.at_s);
    running_.push_back(
        {.fault = fault,
         .at_ns = at_ns,
         .until_ns = fault.for_s ? at_ns + core::nanoseconds(*fault.for_s) : board::kNever});
  }
}

bool BoardFaults::act(core::Nanoseconds now_ns) {
  bool starts_again = false;
  for (Running& running : running_) {
    if (running.state == Running::State::kAhead && now_ns >= running.at_ns) {
      running.state = Running::State::kActive;
      begin(running);
    }
    if (running.state == Running::State::kActive && now_ns >= running.until_ns) {
      running.state = Running::State::kOver;
      starts_again = end(running) || starts_again;
    }
  }
  return starts_again;
}

std::uint64_t BoardFaults::counter_of(const Running& running) const {
  switch (running.fault.kind) {
    case Kind::kBrownOut:
      return board_.profile().instructions();
    case Kind::kStuckBit:
      return board_.stuck_reads();
    case Kind::kLostInterrupt:
      return board_.interrupts().lost(running.fault.interrupt);
    case Kind::kDelayedInterrupt:
      break;
  }
  return board_.interrupts().delayed(running.fault.interrupt);
}

void BoardFaults::begin(Running& running) {
  const BoardFault& fault = running.fault;
  running.before = counter_of(running);
  switch (fault.kind) {
    case Kind::kBrownOut:
      board_.power_off();
      break;
    case Kind::kStuckBit:
      stick_again();
      break;
    case Kind::kLostInterrupt:
      board_.interrupts().lose(fault.interrupt, fault.count);
      break;
    case Kind::kDelayedInterrupt:
      board_.interrupts().delay(fault.interrupt, core::nanoseconds(fault.delay_s));
      break;
  }
}

bool BoardFaults::end(Running& running) {
  switch (running.fault.kind) {
    case Kind::kBrownOut:
      board_.reset();
      return true;
    case Kind::kStuckBit:
      stick_again();
      break;
    case Kind::kDelayedInterrupt:
      board_.interrupts().delay(running.fault.interrupt, 0);
      break;
    case Kind::kLostInterrupt:
      break;
  }
  return false;
}

void BoardFaults::stick_again() {
  board_.free_stuck_bits();
  for (const Running& running : running_) {
    if (running.fault.kind == Kind::kStuckBit && running.state == Running::State::kActive) {
      board_.stick({running.fault.address, running.fault.bit, running.fault.high});
    }
  }
}

std::vector<Check> BoardFaults::checks() const {
  std::vector<Check> checks;
  for (std::size_t i = 0; i < running_.size(); ++i) {
    const Running& running = running_[i];
    Check check;
    check.name =
        running_.size() == 1 ? "board_fault_fired" : fmt::format("board_fault_{}_fired", i + 1);
    check.meaning = "the board's fault changed what the image executed or read";
    std::string why;
    if (running.state == Running::State::kAhead) {
      why = "the run ended before it";
    } else if (running.fault.kind == Kind::kBrownOut && running.state != Running::State::kOver) {
      why = "the run ended before the supply came back";
    } else if (counter_of(running) == running.before) {
      why = running.fault.kind == Kind::kBrownOut   ? "the image did not start again"
            : running.fault.kind == Kind::kStuckBit ? "no read met the bit at its other level"
                                                    : "no such interrupt came";
    } else if (running.fault.kind == Kind::kLostInterrupt &&
               counter_of(running) - running.before < running.fault.count) {
      why = fmt::format("only {} of {} came", counter_of(running) - running.before,
                        running.fault.count);
    }
    check.verdict = why.empty() ? Verdict::kPass : Verdict::kInvalid;
    check.reason = why.empty() ? "" : fmt::format("\"{}\": {}", describe(running.fault), why);
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace towbench::harness
