// What an experiment says of the virtual board alone: how it is wired, how it fails, and what the
// image on it may spend. All need --controller firmware:IMAGE.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/board_wiring.h"

namespace towbench::harness {

struct BoardFault {
  enum class Kind : std::uint8_t { kBrownOut, kStuckBit, kLostInterrupt, kDelayedInterrupt };
  Kind kind = Kind::kBrownOut;
  double at_s = 0;
  // Brown-out: how long the supply is away. Stuck bit, delayed interrupt: how long it lasts; none:
  // to the end of the run.
  std::optional<double> for_s{};
  std::uint32_t address = 0;  // of a stuck bit's register, a multiple of 4
  unsigned bit = 0;
  bool high = true;
  unsigned interrupt = 0;  // input of the AINTC
  unsigned count = 1;      // that are lost
  double delay_s = 1e-3;
};

// The most that the image may spend.
struct BoardBudget {
  enum class Metric : std::uint8_t { kWorstInstructions, kStackBytes };
  Metric metric = Metric::kStackBytes;
  unsigned interrupt = 0;  // of kWorstInstructions: of one service, without what it was nested in
  double max = 0;
  std::string source{};
};

struct BoardPlan {
  std::vector<BoardFault> faults;
  std::vector<BoardBudget> budgets;
  BoardWiring wiring{};
  bool names_wiring = false;  // the experiment has a file of its own for it

  [[nodiscard]] bool empty() const noexcept {
    return faults.empty() && budgets.empty() && !names_wiring;
  }
};

// As on the command line: "board lost_interrupt at=2s interrupt=68 count=3".
[[nodiscard]] std::string describe(const BoardFault& fault);

}  // namespace towbench::harness
