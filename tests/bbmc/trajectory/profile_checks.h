// What every profile owes, whatever its formula: judged from its values alone.
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/trajectory/reference.h"

namespace towbench::bbmc::testing {

// The integral of one member of the reference from `from` to `to` by five-point Gauss-Legendre on
// `panels` panels: knows nothing of how the profile computes its position.
template <typename Profile>
double integrated(const Profile& profile, double Reference::*member, double from_s, double to_s,
                  int panels) {
  constexpr double kNodes[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                               -0.9061798459386640};
  constexpr double kWeights[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                 0.2369268850561891, 0.2369268850561891};
  double sum = 0;
  const double half_s = (to_s - from_s) / panels / 2;
  for (int i = 0; i < panels; ++i) {
    const double middle_s = from_s + (2 * i + 1) * half_s;
    for (int k = 0; k < 5; ++k) {
      sum += kWeights[k] * half_s * profile.at(middle_s + kNodes[k] * half_s).*member;
    }
  }
  return sum;
}

// Position is the integral of velocity everywhere and velocity that of acceleration, and neither
// jumps by more than the largest velocity and acceleration allow.
template <typename Profile>
void expect_consistent(const Profile& profile, double max_speed_m_per_s,
                       double max_acceleration_m_per_s2) {
  constexpr int kSteps = 4000;
  const double end_s = profile.duration_s() + 0.5;
  const double step_s = end_s / kSteps;
  Reference before = profile.at(0);
  double travelled_m = before.position_m;
  double sped_up_m_per_s = before.velocity_m_per_s;
  // Where the acceleration jumps inside a panel the quadrature misses at most one panel's worth; no
  // profile here jumps more than eight times.
  const double jumps_m_per_s = 8 * 2 * max_acceleration_m_per_s2 * step_s / 4;
  for (int i = 1; i <= kSteps; ++i) {
    const double time_s = i * step_s;
    const Reference now = profile.at(time_s);
    travelled_m += integrated(profile, &Reference::velocity_m_per_s, time_s - step_s, time_s, 4);
    sped_up_m_per_s +=
        integrated(profile, &Reference::acceleration_m_per_s2, time_s - step_s, time_s, 4);
    ASSERT_NEAR(now.velocity_m_per_s, sped_up_m_per_s, jumps_m_per_s) << "at " << time_s;
    ASSERT_NEAR(now.position_m, travelled_m, 1e-6 * max_speed_m_per_s) << "at " << time_s;
    ASSERT_LE(std::fabs(now.velocity_m_per_s), max_speed_m_per_s * (1 + 1e-12)) << time_s;
    ASSERT_LE(std::fabs(now.acceleration_m_per_s2), max_acceleration_m_per_s2 * (1 + 1e-12))
        << time_s;
    ASSERT_LE(std::fabs(now.position_m - before.position_m),
              max_speed_m_per_s * step_s * (1 + 1e-9) + 1e-12);
    ASSERT_LE(std::fabs(now.velocity_m_per_s - before.velocity_m_per_s),
              max_acceleration_m_per_s2 * step_s * (1 + 1e-9) + 1e-12)
        << "at " << time_s;
    before = now;
  }
}

}  // namespace towbench::bbmc::testing
