// What a structure leaves of data that its causes were not fitted to, on every row in turn.
//
// Each run is cut into stretches long enough to be independent of their neighbours. A stretch's
// residual is taken with the causes' coefficients fitted to all the others, and not corrected by
// the simulated reference: through a column that is noisy itself the true coefficient predicts less
// well than the fitted one. So a cause can be asked whether it predicts, without setting data aside
// for the question alone (Stone 1974; blocks against serial correlation: Racine 2000).
//
// The nominal model is no candidate: with and without a cause it is fitted to everything, by taking
// its columns off the input and the causes first (Frisch & Waugh 1933). Fitted without the fastest
// stretch it would say of the viscous force there what it must guess, and that guess, not the
// cause, would decide.
//
// What shows in a few places only (clipped peaks, reversals) may be all but missing from the rest:
// a plain fit would take any coefficient that the noise there likes. A cause's coefficients are
// therefore drawn to what its law says of them, or to zero where it leaves them open, by a prior
// worth one sample (Kass & Wasserman 1995): of what has not been seen the law predicts, or nothing
// does; what has been seen is not held back.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "study/diagnose/evidence.h"

namespace towbench::harness::diagnose {

inline constexpr Eigen::Index kQuarters = 4;  // the longest stretches that are of use

// Of a run, by how long the residual of the structure without causes remembers.
[[nodiscard]] Eigen::Index stretches_of(const Evidence& without_causes);

[[nodiscard]] Eigen::VectorXd cross_validated_residual(const Evidence& evidence,
                                                       const std::vector<Term>& terms,
                                                       Eigen::Index stretches);

}  // namespace towbench::harness::diagnose
