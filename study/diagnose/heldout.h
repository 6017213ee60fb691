// What a term gains on data that its selection never saw.
//
// What differs between sessions (offset, level of dry friction, phase of a ripple) is estimated
// again on the first quarter of each held-out run, before and after alike; that quarter is never
// scored. The second quarter decides which causes stand, the rest is what the result is scored on.
// A part of the same session is scored as it is.
#pragma once

#include <cstdint>
#include <vector>

#include "study/diagnose/evidence.h"
#include "study/diagnose/gain.h"

namespace towbench::harness::diagnose {

// A model as fitted elsewhere.
struct FittedModel {
  std::vector<Term> terms;
  Eigen::VectorXd coefficients;
};

// Which rows of each run are re-calibrated on (from its start) and which are scored, as shares.
struct ScoredPart {
  double calibrated = 0;
  double from = 0;
  double to = 1;
};
inline constexpr ScoredPart kSameSession{};
inline constexpr ScoredPart kGateOfAnotherSession{.calibrated = 0.25, .from = 0.25, .to = 0.5};
inline constexpr ScoredPart kRestOfAnotherSession{.calibrated = 0.25, .from = 0.5, .to = 1.0};

class HeldOut {
 public:
  HeldOut(const Dataset& data, const Context& context, const ScoredPart& part);

  // Of one run's rows: re-calibrated on the first, scored `count` of them.
  struct Rows {
    Eigen::Index calibrated = 0;
    Eigen::Index from = 0;
    Eigen::Index count = 0;
  };
  [[nodiscard]] const Dataset& data() const noexcept { return data_; }
  [[nodiscard]] const Rows& scored(std::size_t member) const { return scored_[member]; }
  // The model's coefficients for one run: what a session shifts taken from its calibrated part.
  [[nodiscard]] Eigen::VectorXd coefficients_in(std::size_t member, const FittedModel& model) const;
  // Residual of a model on the scored rows.
  [[nodiscard]] Eigen::VectorXd residual(const FittedModel& model) const;
  [[nodiscard]] Gain gain(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                          std::uint64_t seed) const;
  // Scored rows of all runs together.
  [[nodiscard]] Eigen::Index rows() const noexcept { return scored_starts_.back(); }
  [[nodiscard]] double force_rms_N() const;

 private:
  [[nodiscard]] Eigen::VectorXd recalibrated(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                             const FittedModel& model,
                                             Eigen::Index calibration_rows) const;

  const Dataset& data_;
  const Context& context_;
  std::vector<Rows> scored_;                 // one a run
  std::vector<Eigen::Index> scored_starts_;  // where each run's begin, and the total at the end
};

}  // namespace towbench::harness::diagnose
