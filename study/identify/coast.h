// Mechanical time constant J/B from an axis that coasts: no torque, so no drive constant is needed.
//
//   J q'' + B q' + C = 0       q(t) = a + b t + c exp(-t B/J)
//
// and on top, since the motor lets go of a stretched transmission, one damped swing
//   exp(-s t) (p cos wt + q sin wt).
// J/B, w and s are common to all coasts of a set, the rest is each one's own (variable projection).
#pragma once

#include <limits>
#include <vector>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct CoastSpan {
  std::size_t from = 0;
  std::size_t to = 0;  // one past
};

struct CoastLimits {
  double lowest_share = 0.2;
  // A motor whose back EMF is beyond the amplifier's voltage is braked through its winding,
  // whatever the set-point: that is no coast.
  double fastest_m_per_s = std::numeric_limits<double>::infinity();
};

// After each stretch of duty: from where the motor, swing and all, stays below the fastest until
// its speed has fallen to `lowest_share` of what it was. Spans below 50 ms are left out.
[[nodiscard]] std::vector<CoastSpan> find_coasts(const Recording& data, core::Axis axis,
                                                 const CoastLimits& limits = {});

struct CoastFit {
  double time_constant_s = 0;
  double swing_Hz = 0;
  double residual_rms_counts = 0;
  bool converged = false;
};

// `first_s`, `first_Hz`: where the search begins.
[[nodiscard]] CoastFit fit_coasts(const Recording& data, core::Axis axis,
                                  const std::vector<CoastSpan>& spans, double first_s,
                                  double first_Hz);

}  // namespace towbench::study::identify
