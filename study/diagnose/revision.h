// The same said with less: other answers of fewer names that predict as well.
//
// Forward selection may open with a substitute: Stribeck friction with other viscous and Coulomb
// friction bends like drag that grows with the square of speed. So each accepted cause in turn, and
// all of them together with the parameters that moved, are taken out and every other effect is
// tried in their place. The answer with the fewest names (causes, and things that moved of the
// nominal model) stands, unless it predicts worse for certain; of as many names, the one that
// predicts better for certain.
//
// Two causes may together look like one other and parameters that moved, and neither alone better
// than that: where no single one says it better, two that would be no more names are tried at once.
#pragma once

#include <optional>
#include <vector>

#include "study/diagnose/candidates.h"
#include "study/diagnose/gates.h"
#include "study/diagnose/shortlist.h"

namespace towbench::harness::diagnose {

struct Added {
  Term term;
  double p_value = 1;  // corrected for the number tried
  Gain gain;           // at home, over all the others
};

struct Revision {
  Trial stand;               // its last terms are those that were put in
  std::vector<Added> added;  // one, or two
};

// None: nothing says it better. `least_N` as in shortlist().
[[nodiscard]] std::optional<Revision> revised(const Trial& stand, const NominalModel& model,
                                              const Gates& gates, Candidates& candidates,
                                              double least_N);

}  // namespace towbench::harness::diagnose
