// Moves scales that enter nonlinearly from the best grid point to the least residual.
//
// Variable projection (Golub & Pereyra 1973): for each scale the linear coefficients are solved
// exactly, so Ceres sees only the scales, in their logarithms, inside +-reach. A coefficient is at
// most what its law says.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {

[[nodiscard]] Scales refine_scales(const Effect& effect, const Scales& start, double reach,
                                   const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual,
                                   const std::function<Eigen::MatrixXd(const Scales&)>& columns);

}  // namespace towbench::harness::diagnose
