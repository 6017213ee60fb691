// What several families of effects share: steps of a derivative, and grids of a scale.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "study/prediction/effect.h"

namespace towbench::study::diagnose {

// A fiftieth of the input's rms, as a force and as what makes it at top speed.
inline double force_step(const Context& c) {
  return 0.02 * c.input_rms_N;
}
inline double viscous_step(const Context& c) {
  return force_step(c) / c.top_speed_m_per_s;
}
inline double drag_step(const Context& c) {
  return viscous_step(c) / c.top_speed_m_per_s;
}
inline double cubic_step(const Context& c) {
  return drag_step(c) / c.top_speed_m_per_s;
}
inline double share_step(const Context& /*c*/) {
  return 0.02;
}
inline double whole_step(const Context& /*c*/) {
  return 1;
}

inline std::vector<Scales> no_scale(const Context& /*c*/) {
  return {{}};
}
inline std::vector<Scales> multiples(std::initializer_list<double> factors, double of) {
  std::vector<Scales> grid;
  for (const double factor : factors) grid.push_back({factor * of});
  return grid;
}

inline void set_nothing(Parameters& /*p*/, const Context& /*c*/, std::span<const double> /*s*/) {}
template <Key key>
void set_scale(Parameters& p, const Context& /*c*/, std::span<const double> scales) {
  p[key] = scales[0];
}

}  // namespace towbench::study::diagnose
