// The thesis's own controller on the bench: its trapezoids (Tables 7.6, 8.3) and its circle (Figs
// 7.14, 7.15) with one set of gains.
#pragma once

#include <string>
#include <vector>

#include "study/results/tracked_run.h"

namespace towbench::study {

struct OwnGains {
  std::string controller;  // name of its fixture
  double proportional_Nm_per_count = 0;
  double integral_Nm_per_count_s = 0;
  double derivative_Nm_s_per_count = 0;
  double m_per_count = 0;
  std::vector<TrackedSpeed> early;  // Table 7.6, 2 s of steady speed, 1 s after the ramp
  std::vector<TrackedSpeed> whole;  // Table 7.6, all of the track that a log of BBMC 0.5 holds
  std::vector<TrackedSpeed> fast;   // Table 8.3, in air
  TrackedCircle circle;

  [[nodiscard]] double integral_rate_per_s() const noexcept {
    return integral_Nm_per_count_s / proportional_Nm_per_count;
  }
};

[[nodiscard]] OwnGains track_gains(const harness::RigFixture& rig,
                                   const harness::ControllerFixture& controller);

}  // namespace towbench::study
