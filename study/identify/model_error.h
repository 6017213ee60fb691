// By how much a model of a wrong structure may have bent its parameters.
//
//   r = e + d        residuals: e what a right model leaves, d the structure's own error
//
// Least squares leave of the structure's error only what no parameter imitates; what they have
// taken in, J delta, is seen nowhere. It is bounded by the part that is left: |J delta| <= |d|, so
// that, with P of the priors,
//
//   |delta_i| <= sqrt([(J^T J + P)^-1]_ii) |d|        (Cauchy-Schwarz)
//
// That the two parts are alike is *assumed*; docs/measurements/identification-foreign.md shows how
// far it holds, and the fit takes three times the bound.
#pragma once

#include <Eigen/Core>

namespace towbench::study::identify {

// |d|^2: squares left beyond those of a right model, which leaves `right_rms` a row. 0 where there
// are none.
[[nodiscard]] double structure_error(const Eigen::VectorXd& residual, double right_rms);

// |delta_i| of each parameter, in its own unit. `jacobian`, `residual`: of the data; `prior`: P.
[[nodiscard]] Eigen::VectorXd most_bent(const Eigen::MatrixXd& jacobian,
                                        const Eigen::VectorXd& residual,
                                        const Eigen::MatrixXd& prior, double right_rms);

}  // namespace towbench::study::identify
