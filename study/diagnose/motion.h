// A run's speed, acceleration and input at its full rate, smoothed alike, for tests and pictures.
#pragma once

#include <Eigen/Core>

#include "study/prediction/run.h"

namespace towbench::study::diagnose {

struct Motion {
  Eigen::VectorXd time_s;
  Eigen::VectorXd position_m;
  Eigen::VectorXd speed_m_per_s;
  Eigen::VectorXd acceleration_m_per_s2;
  Eigen::VectorXd input_N;
};

// Of a line through the position, where nothing else is asked for.
inline constexpr double kSmooth_s = 0.01;

// Each value over `window_s` either side: a line through the position, a mean of the input.
[[nodiscard]] Motion motion_of(const Run& run, double window_s);

}  // namespace towbench::study::diagnose
