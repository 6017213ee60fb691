// What a person did to a run while it ran: part of the experiment once it is over, so that the run
// can be replayed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/time.h"

namespace towbench::harness {

struct OperatorAct {
  // What is broken and cleared stands in the experiment's faults too; those make it happen.
  enum class Kind : std::uint8_t { kTyped, kFault, kCleared, kChanged, kClock, kHolds, kFinished };
  core::Nanoseconds time_ns = 0;  // of the exchange before which it was done
  Kind kind = Kind::kClock;
  // Bytes for the console; a fault in words; what was changed before the start; what was done to
  // the clock.
  std::string text;

  // Whether the budgets of the undisturbed run still say something.
  [[nodiscard]] bool disturbs() const noexcept { return kind < Kind::kClock; }
};

inline constexpr std::string_view kOperatorActNames[] = {"typed", "fault", "cleared", "changed",
                                                         "clock", "holds", "finished"};
[[nodiscard]] inline std::string_view name_of(OperatorAct::Kind kind) noexcept {
  return kOperatorActNames[static_cast<std::size_t>(kind)];
}

}  // namespace towbench::harness
