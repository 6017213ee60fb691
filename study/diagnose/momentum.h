// Momentum over windows: M dv + B dq + C [direction] dt + b dt = sum of the input, and of a joint
// G_s sum sin q dt + G_c sum cos q dt beside it. A first fit without a simulation, and what tells
// whether the columns are what they are said to be.
#pragma once

#include <limits>
#include <vector>

#include "study/prediction/nominal_model.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

inline constexpr double kUnlimited_N = std::numeric_limits<double>::infinity();

struct Momentum {
  double mass_kg = 0;
  double viscous_N_s_per_m = 0;
  double coulomb_N = 0;
  double bias_N = 0;
  double explained = 0;  // share of the impulse's energy about its mean
  Eigen::Index windows = 0;
  double most_N = kUnlimited_N;  // to which the input was limited
};

// With the input moved by `shift_s` against the position, and limited to `most_N`.
[[nodiscard]] Momentum fit_momentum(const std::vector<Run>& runs, bool rotary, double shift_s,
                                    double most_N = kUnlimited_N);

// Limited where a drive that clips leaves half of what is unexplained otherwise, or less.
[[nodiscard]] Momentum fit_momentum_of_drive(const std::vector<Run>& runs, bool rotary);

}  // namespace towbench::study::diagnose
