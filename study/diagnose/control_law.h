// The controller behind a log: read off it, or replaced by a stiff law that follows the motion.
//
// The law that is fitted: u_k = K_P e_k + K_D (e_k - e_(k-1)) / T + K_I sum e T + K_V r'_k + K_A
// r''_k
// + K_C sgn r'_k + K_W v_k + c, with e = reference - position: PID, cascades of P loops, and
// feed-forward. It counts as found when it reproduces 98 % of the input's energy about its mean.
#pragma once

#include <Eigen/Core>

#include "study/diagnose/run.h"

namespace towbench::harness::diagnose {

struct ControlLaw {
  enum class Kind { kFitted, kTracking };
  Kind kind = Kind::kTracking;
  Eigen::VectorXd gains;  // of kFitted, in the order above
  double reproduced = 0;  // share of the input's energy about its mean
};

inline constexpr Eigen::Index kLawTerms = 8;

// The law's terms at sample k, from what the controller could know then.
struct LawState {
  double integral_m_s = 0;
  double last_error_m = 0;
  double last_position_m = 0;

  [[nodiscard]] Eigen::Matrix<double, kLawTerms, 1> terms(const Run& run, Eigen::Index k,
                                                          double position_m);
};

[[nodiscard]] ControlLaw find_control_law(const Run& run);

}  // namespace towbench::harness::diagnose
