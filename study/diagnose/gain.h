// What one residual is smaller than another by, and how sure that is.
//
//   G = 1 - RMS(after) / RMS(before)
// with a block bootstrap over time: blocks longer than the residual's correlation are drawn with
// replacement (Kuensch 1989; Politis & Romano 1992, circular), the same blocks for before and
// after.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace towbench::harness::diagnose {

struct Interval {
  double value = 0;
  double low = 0;
  double high = 0;
};

struct Gain {
  Interval ci99;  // as a share, 0.1 = 10 %
  Interval ci95;
  double before_rms_N = 0;
  double after_rms_N = 0;
};

// Both residuals on the same rows; `starts`: where each run's rows begin, and the total at the end.
[[nodiscard]] Gain gain_of(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                           const std::vector<Eigen::Index>& starts, std::uint64_t seed);

// The same of nested models, were the same motion made again: the residual is drawn anew and the
// motion is not (regressors fixed or drawn, Freedman 1981). What three clipped peaks show is not
// less sure because another motion might have had none.
[[nodiscard]] Gain gain_on_this_motion(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                                       const std::vector<Eigen::Index>& starts);

}  // namespace towbench::harness::diagnose
