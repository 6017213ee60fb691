// The effects that the residual of a model speaks for, best first.
//
// Each effect is tried at its best scale, its group Wald p-value corrected for all that was tried.
// The order is by the Bayesian information criterion on effective samples (Schwarz 1978), so that a
// flexible group does not beat a simple one for its flexibility alone.
#pragma once

#include <vector>

#include "study/diagnose/candidates.h"

namespace towbench::harness::diagnose {

inline constexpr double kAlpha = 1e-3;
inline constexpr double kLeastLeft = 0.05;  // of a group off the model, rms; below: not testable

struct Shortlist {
  std::vector<Candidate> all;   // of every effect, as it came
  std::vector<Candidate> best;  // significant and plausible, the first of them at refined scales
};

// `least_N`: rms that an effect must have off the model.
[[nodiscard]] Shortlist shortlist(Candidates& candidates, const Evidence& evidence,
                                  const std::vector<Term>& taken, double least_N);

}  // namespace towbench::harness::diagnose
