#include "harness/diagnose/context.h"

#include <algorithm>

#include "harness/diagnose/evidence.h"

namespace towbench::harness::diagnose {

Context make_context(const NominalModel& model, const Dataset& data) {
  Context c;
  c.model = model;
  c.cutoff_Hz = data.conditioning.cutoff_Hz;
  c.stroke_min_m = 1e300;
  c.stroke_max_m = -1e300;
  for (const auto& member : data.members) {
    const Signals& s = member.signals;
    c.top_speed_m_per_s = std::max(c.top_speed_m_per_s, s.speed_m_per_s.cwiseAbs().maxCoeff());
    c.stroke_min_m = std::min(c.stroke_min_m, s.position_m.minCoeff());
    c.stroke_max_m = std::max(c.stroke_max_m, s.position_m.maxCoeff());
    c.largest_input_N = std::max(c.largest_input_N, s.force_N().cwiseAbs().maxCoeff());
    c.resolution_m = std::max(c.resolution_m, member.run.resolution_m);
    c.acceleration_noise_m_per_s2 =
        std::max(c.acceleration_noise_m_per_s2,
                 acceleration_noise_m_per_s2(member.run, data.conditioning.smoothing_Hz));
    c.period_s = std::max(c.period_s, s.period_s);
    c.duration_s = std::max(c.duration_s, s.time_s[s.size() - 1]);
  }
  c.theta = weigh(data, c, {}, {}, 0, 0).theta();
  return c;
}

}  // namespace towbench::harness::diagnose
