// What a term gains on data that its selection never saw.
//
//   G = 1 - RMS(after) / RMS(before)
// with a block bootstrap over time: blocks longer than the residual's correlation are drawn with
// replacement (Kuensch 1989; Politis & Romano 1992, circular), the same blocks for before and
// after.
//
// What differs between sessions (offset, level of dry friction, phase of a ripple) is estimated
// again on the first quarter of each held-out run, before and after alike; that quarter is not
// scored. A held-out part of the same session is scored as it is.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/diagnose/evidence.h"

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

// A model as fitted elsewhere.
struct FittedModel {
  std::vector<Term> terms;
  Eigen::VectorXd coefficients;
};

inline constexpr double kCalibrationShare = 0.25;

class HeldOut {
 public:
  // `same_session`: the rows are other parts of the runs that the fit saw; nothing is re-estimated.
  HeldOut(const Dataset& data, const Context& context, bool same_session);

  // Residual of a model on the scored rows.
  [[nodiscard]] Eigen::VectorXd residual(const FittedModel& model) const;
  [[nodiscard]] Gain gain(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                          std::uint64_t seed) const;
  [[nodiscard]] double force_rms_N() const;

 private:
  [[nodiscard]] Eigen::VectorXd recalibrated(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                             const FittedModel& model,
                                             Eigen::Index scored_from) const;

  const Dataset& data_;
  const Context& context_;
  bool same_session_;
  std::vector<Eigen::Index> scored_starts_;
  std::vector<Eigen::Index> calibration_rows_;  // one a run
};

}  // namespace towbench::harness::diagnose
