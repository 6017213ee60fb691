// What a run speaks against is not named: a held-out run that is surely predicted worse with it
// than without, or a fitted one that is predicted much worse than by the stated model. A push takes
// the fit to causes that no other run has.
#pragma once

#include <vector>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// No cause is left in `search`; what they took on is unexplained.
void refute_causes(Diagnosis& d, const std::vector<Run>& holdout, const Data& fitted,
                   Search& search);

// No parameter has moved, where the causes are refuted or there are none.
void refute_parameters(Diagnosis& d, const std::vector<Run>& holdout, const Data& fitted,
                       const Search& search);

}  // namespace towbench::study::diagnose
