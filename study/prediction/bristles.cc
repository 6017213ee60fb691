#include "study/prediction/bristles.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::diagnose {
namespace {

constexpr double kCame_s = 0.1;  // of motion assumed before a log begins

}  // namespace

Bristles::Bristles(const Parameters& p) {
  if (p[Key::kPresliding] == 0) return;
  level_N_ = std::min(0.5 * p[Key::kPresliding], p[Key::kCoulomb]);
  travel_m_ = p[Key::kPreslidingTravel];
  unbent_N_s_per_m_ = level_N_ * p[Key::kPreslidingTime] / travel_m_;
}

void Bristles::place(double position_m, double speed_m_per_s) {
  bend_ = 0;
  at_m_ = position_m - kCame_s * speed_m_per_s;
  go_to(position_m);
}

// Exact, however long the way.
void Bristles::go_to(double position_m) {
  const double way_m = position_m - at_m_;
  if (way_m == 0) return;
  const double end = way_m > 0 ? 1 : -1;
  bend_ = end - (end - bend_) * std::exp(-std::abs(way_m) / travel_m_);
  at_m_ = position_m;
}

double Bristles::damping_N_s_per_m() const noexcept {
  return unbent_N_s_per_m_ * (1 - std::abs(bend_));
}

}  // namespace towbench::study::diagnose
