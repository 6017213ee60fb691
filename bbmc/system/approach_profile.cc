#include "bbmc/system/approach_profile.h"

#include <algorithm>
#include <cmath>

namespace towbench::bbmc {

void ApproachProfile::begin(double start_m, double target_m, double speed_m_per_s,
                            double acceleration_m_per_s2) noexcept {
  target_m_ = target_m;
  position_m_ = start_m;
  speed_m_per_s_ = 0;
  speed_limit_m_per_s_ = speed_m_per_s;
  acceleration_m_per_s2_ = acceleration_m_per_s2;
}

Reference ApproachProfile::step(double step_s) noexcept {
  if (arrived()) {
    return {.position_m = target_m_};
  }
  const double direction = left_m() > 0 ? 1.0 : -1.0;
  const double distance_m = std::fabs(left_m());
  const double a = acceleration_m_per_s2_;
  const double before = speed_m_per_s_;
  // After a step at v the rest must do with v^2 / 2a: v T + v^2 / 2a = d.
  const double stoppable = a * (std::sqrt(step_s * step_s + 2.0 * distance_m / a) - step_s);
  speed_m_per_s_ = std::min({before + a * step_s, speed_limit_m_per_s_, stoppable});
  const double travelled = speed_m_per_s_ * step_s;
  constexpr double kHere_m = 1e-7;  // far below a count
  if (travelled >= distance_m || distance_m < kHere_m) {
    position_m_ = target_m_;
    speed_m_per_s_ = 0;
    return {.position_m = target_m_};
  }
  position_m_ += direction * travelled;
  return {.position_m = position_m_,
          .velocity_m_per_s = direction * speed_m_per_s_,
          .acceleration_m_per_s2 = direction * (speed_m_per_s_ - before) / step_s};
}

}  // namespace towbench::bbmc
