// A change of one of the machine's lines, with its time.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/bounded_vector.h"
#include "core/time.h"
#include "protocol/messages.h"

namespace towbench::emulator {

struct LineChange {
  core::Nanoseconds time_ns = 0;
  protocol::InputLine line = protocol::InputLine::kKillSwitch;
  bool active = false;
};

// Enough for every line: a hall sensor changes at most four times a step (its field crosses once in
// each monotone third of the motion, plus one change pending), a home switch at most eight times
// (two edges), each of three ready lines once; contact bounce and changes of the wiring are
// admitted up to these numbers.
inline constexpr std::size_t kMaxKillChangesPerStep = 12;
inline constexpr std::size_t kMaxWiringChangesPerStep = 8;
inline constexpr std::size_t kMaxLineChangesPerStep =
    (4 * 2 + 8) * core::kMostAxes + 3 + kMaxKillChangesPerStep + kMaxWiringChangesPerStep;
using LineChanges = core::BoundedVector<LineChange, kMaxLineChangesPerStep>;

}  // namespace towbench::emulator
