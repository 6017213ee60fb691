// Candidate models: a set of terms fitted, and what it leaves where it was not fitted.
//
// A cause is accepted when its within-session gain, cross-validated, is certain, and a gain on
// another run is likely; of the only run of a rigid axis when it is likely at home, for score.h
// asks all rows once more. A line in time must gain across quarters of the run too: a burst of
// ringing, cut into short stretches, looks like a line to its neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "study/diagnose/evidence.h"
#include "study/diagnose/heldout.h"

namespace towbench::harness::diagnose {

inline constexpr double kLeastGain = 0.01;
inline constexpr int kReferenceRounds = 2;

struct Trial {
  std::vector<Term> terms;
  Evidence evidence;
  Eigen::VectorXd home;       // residual, cross-validated
  Eigen::VectorXd far;        // the same across quarters of each run
  Eigen::VectorXd other_run;  // residual on a part of another run; empty without one

  [[nodiscard]] double home_rms_N() const;
};

// The higher of two lower bounds.
[[nodiscard]] Gain surest(Gain one, const Gain& other);
[[nodiscard]] bool certain(const Gain& gain);

class Gates {
 public:
  // `other_run`: a part of another run, short as it is, or null.
  Gates(const Dataset& data, const HeldOut* other_run, const Context& context, std::uint64_t seed);

  // `rounds` of the simulated reference; fewer are cheaper and less exact.
  [[nodiscard]] Trial trial(const std::vector<Term>& terms, int rounds = kReferenceRounds) const;
  // Sure when it is sure of another motion, or of this one with other noise: each bound errs once
  // in two hundred times, so that the higher of both is a lower bound of 99 %.
  [[nodiscard]] Gain within_session_gain(const Trial& before, const Trial& after) const;
  // Whether what `after` has and `before` lacks stands. With the rest: the other causes are in, so
  // that little is left to hide behind, and the gain on another run must be certain too.
  [[nodiscard]] bool stands(const Gain& home, const Trial& before, const Trial& after,
                            bool with_the_rest) const;
  // Whether chance alone can be the reason that `one` predicts less well than `other`.
  [[nodiscard]] bool as_good(const Trial& one, const Trial& other) const;

 private:
  // Of the only run of a rigid axis the rest is asked with it, at the end (score.h).
  [[nodiscard]] bool provisional() const {
    return other_run_ == nullptr && !context_.model.elastic();
  }

  const Dataset& data_;
  const HeldOut* other_run_;
  const Context& context_;
  std::uint64_t seed_;
  std::vector<ControlLaw> laws_;
  Eigen::Index stretches_ = 0;  // of cross-validation: the same for all trials
};

}  // namespace towbench::harness::diagnose
