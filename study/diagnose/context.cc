#include "study/diagnose/context.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/evidence.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kNextToNothing = 0.003;

// The encoder's steps in the acceleration grow with the band's width to the power of 5/2.
double quiet_Hz(const Dataset::Member& member, const Conditioning& conditioning, double mass_kg) {
  const double noise_N =
      mass_kg * acceleration_noise_m_per_s2(member.run, conditioning.smoothing_Hz);
  const double force_N =
      member.signals.force_N().norm() / std::sqrt(static_cast<double>(member.signals.size()));
  const double share = kNextToNothing * force_N / std::max(1e-12, noise_N);
  return conditioning.smoothing_Hz * std::min(1.0, std::pow(share, 0.4));
}

}  // namespace

Context make_context(const NominalModel& model, const Dataset& data) {
  Context c;
  c.model = model;
  c.cutoff_Hz = data.conditioning.cutoff_Hz;
  c.stroke_min_m = 1e300;
  c.stroke_max_m = -1e300;
  c.quiet_Hz = data.conditioning.smoothing_Hz;
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
    c.quiet_Hz = std::min(c.quiet_Hz, quiet_Hz(member, data.conditioning, model.mass_kg));
    c.period_s = std::max(c.period_s, s.period_s);
    c.duration_s = std::max(c.duration_s, s.time_s[s.size() - 1]);
  }
  c.theta = fit_bias_corrected(data, c, {}, {}, 0, 0).theta();
  return c;
}

}  // namespace towbench::harness::diagnose
