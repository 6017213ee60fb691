// What a brake is told at each exchange.
#pragma once

#include "core/time.h"

namespace towbench::bbmc {

struct BrakeInput {
  core::Nanoseconds now_ns = 0;
  double speed_count_per_s = 0;    // as the encoder tells it
  core::Nanoseconds age_ns = 0;    // of that
  core::Nanoseconds since_ns = 0;  // over which it is a mean, if that is long
  // Of the whole axis, without the motor's swing on the chain (dead_reckoning.h).
  double momentum_count_per_s = 0;
};

}  // namespace towbench::bbmc
