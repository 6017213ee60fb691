// What a structure leaves of data that its coefficients were not fitted to, on every row in turn.
//
// Each run is cut into stretches, every fourth of which belongs to one fold: long enough to be
// independent of their neighbours, short enough that no fold holds all of one kind of motion (of
// thirty seconds, three may be fast; coefficients fitted without them would be extrapolated). A
// fold's residual is taken with coefficients fitted to the other three, moved by the twin's
// correction of the whole. So a cause can be asked whether it predicts, without setting data aside
// for the question alone (Stone 1974; blocks against serial correlation: Racine 2000).
#pragma once

#include <Eigen/Core>

#include "harness/diagnose/evidence.h"

namespace towbench::harness::diagnose {

inline constexpr Eigen::Index kFewestStretches = 12;

// Of a run, by how long the residual of the structure without causes remembers.
[[nodiscard]] Eigen::Index stretches_of(const Evidence& without_causes);

[[nodiscard]] Eigen::VectorXd cross_validated_residual(const Evidence& evidence,
                                                       Eigen::Index stretches);

}  // namespace towbench::harness::diagnose
