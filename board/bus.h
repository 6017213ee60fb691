// What every peripheral of the virtual board shares: the time of the access that is being served,
// and what accesses have done that an idle loop would not do.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/time.h"

namespace towbench::board {

inline constexpr core::Nanoseconds kNever = std::numeric_limits<core::Nanoseconds>::max();

struct Bus {
  core::Nanoseconds now_ns = 0;
  // Accesses to peripherals so far, and those of them that no idle loop makes: writes, reads with
  // an effect, reads of what moves with time by itself.
  std::uint64_t accesses = 0;
  std::uint64_t disturbances = 0;
  // What the image asked for that is kept but not modelled, each thing once.
  std::vector<std::string> notes;
  // The first register whose value decided something, and is not modelled; empty: none has.
  std::string doubt;

  void disturb() noexcept { ++disturbances; }
};

}  // namespace towbench::board
