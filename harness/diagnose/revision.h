// The same said with less: other answers of fewer names that predict as well.
//
// Forward selection may open with a makeshift: Stribeck friction with other viscous and Coulomb
// friction bends like drag that grows with the square of speed. So each accepted cause in turn, and
// all of them together with the parameters that moved, are taken out and every other effect is
// tried in their place. The answer with the fewest names (causes, and things that moved of the
// nominal model) stands, unless it predicts worse for certain; of as many names, the one that
// predicts better for certain.
#pragma once

#include <optional>
#include <vector>

#include "harness/diagnose/candidates.h"
#include "harness/diagnose/gates.h"
#include "harness/diagnose/shortlist.h"

namespace towbench::harness::diagnose {

struct Revision {
  Trial stand;
  Term added;
  double p_value = 1;  // of what was put in, corrected for the number tried
  Gain gain;           // of what was put in, at home
};

// None: nothing says it better. `least_N` as in shortlist().
[[nodiscard]] std::optional<Revision> revised(const Trial& stand, const NominalModel& model,
                                              const Gates& gates, Candidates& candidates,
                                              double least_N);

}  // namespace towbench::harness::diagnose
