// Is something left that no effect of the library is? The residual is cut into bins along each
// coordinate; bins of pure noise have means that a group Wald test does not tell from zero.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "study/diagnose/evidence.h"

namespace towbench::harness::diagnose {

struct Unexplained {
  std::string coordinate;
  double share = 0;             // of the residual's energy that the binned shape holds
  double rms_N = 0;             // of that shape
  double p_value = 1;           // corrected for the coordinates tried
  std::vector<double> at;       // middle of each bin
  std::vector<double> force_N;  // mean residual in it
  std::vector<double> error_N;  // its standard error
};

// The coordinate along which most is left; none when all are quiet. A shape below 1 % of the
// force's rms, or below what the simulated reference shows by itself, is too small to matter.
[[nodiscard]] std::optional<Unexplained> find_unexplained(const Dataset& data,
                                                          const Evidence& evidence);

}  // namespace towbench::harness::diagnose
