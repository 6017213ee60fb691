// How a prediction is corrected by what was measured: the steady Kalman filter of the axis without
// dry friction, for white forces on its bodies and white noise of the position (Anderson, Moore
// 1979).
#pragma once

#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {

// Of the state, a metre that the measured position is off. A rigid axis has the motor alone.
struct Correction {
  double motor_m = 0;
  double motor_m_per_s = 0;  // a metre
  double load_m = 0;
  double load_m_per_s = 0;
};

// `bandwidth`, rad/s: the noises are such that a rigid axis of the same mass forgets by it. A
// constant force F that is missing leaves F / (M w^2).
[[nodiscard]] Correction correction_of(const Parameters& parameters, double period_s,
                                       double bandwidth);

}  // namespace towbench::study::diagnose
