// How strong and how many pulses an axis takes: its response to two small ones, and a rigid body
// that behaves like them.
#pragma once

#include "study/procedures/procedure.h"

namespace towbench::harness::procedures {

struct PulsePlan {
  double duty_pct = 0;
  int pulses = 0;
  double reach_m = 0;   // expected
  std::string refusal;  // empty: can be run
};

struct PulseWish {
  double on_s = 0.3;
  double off_s = 0.3;
  double peak_share = 0.65;  // of the saturation speed
  double longest_m = 2.68;   // 7.2.1
  int most_pulses = 30;
};

// Moves the axis, a little, when it may. `start_m`: where the pulses will begin.
[[nodiscard]] PulsePlan plan_pulses(const ProcedureContext& context, const PulseWish& wish,
                                    double start_m);

}  // namespace towbench::harness::procedures
