// Size and number of the pulses that fit an axis, from its response to two small pulses and a rigid
// body fitted to them.
#pragma once

#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

struct PulsePlan {
  double duty_pct = 0;
  int pulses = 0;
  double reach_m = 0;   // expected
  std::string refusal;  // empty: can be run
};

// What the pulses must keep to.
struct PulseLimits {
  double on_s = 0.3;
  double off_s = 0.3;
  double peak_share = 0.65;  // of the saturation speed
  double longest_m = 2.68;   // 7.2.1
  int most_pulses = 30;
};

// Plays the two small pulses on the axis. `start_m`: where the planned pulses will begin.
[[nodiscard]] PulsePlan plan_pulses(const ProcedureContext& context, const PulseLimits& limits,
                                    double start_m);

}  // namespace towbench::study::procedures
