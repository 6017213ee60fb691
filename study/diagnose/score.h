// The accepted causes fitted once more to all data but the held-out, and what they gain there: on
// data that neither the fit nor the selection has seen, so that the figure promises nothing that
// choosing among many effects has made. A cause that loses there is withdrawn, and on an
// elastic axis one that gains less than half of what it promises. The score may take a cause away,
// never give one.
//
// Of the only run of a rigid axis the held-out quarter and the rest decide together: what the gates
// let pass as likely stands when its gain over all rows, each predicted by a fit without it, is
// certain, alone or beside an effect that predicts and is not certain itself. So a weak cause need
// not be certain on three quarters of the data, and then show on the last one besides.
#pragma once

#include <cstdint>

#include "study/diagnose/selection.h"

namespace towbench::harness::diagnose {

// Fills in before, after, gain of `selection`, and beta, covariance, gain of each of its causes.
// `same_session`: the held-out rows are of the run that was fitted.
void refit_and_score(Selection& selection, const Dataset& fit, const HeldOut& heldout,
                     const Context& context, std::uint64_t seed, bool same_session);

}  // namespace towbench::harness::diagnose
