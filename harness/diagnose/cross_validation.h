// What a structure leaves of data that its coefficients were not fitted to, on every row in turn.
//
// Each run is cut into stretches, every fourth of which belongs to one fold. A fold's residual is
// taken with coefficients fitted to the other three, moved by the twin's correction of the whole.
// So a cause can be asked whether it predicts, without setting data aside for the question alone
// (Stone 1974; blocks against serial correlation: Racine 2000).
#pragma once

#include <Eigen/Core>

#include "harness/diagnose/evidence.h"

namespace towbench::harness::diagnose {

[[nodiscard]] Eigen::VectorXd cross_validated_residual(const Evidence& evidence);

}  // namespace towbench::harness::diagnose
