// Coefficients of the nominal structure, load side: F = M a + B v + C sgn v + b.
#pragma once

#include <Eigen/Core>

namespace towbench::harness::diagnose {

// Base columns, in this order.
enum BaseColumn : Eigen::Index { kMass, kViscous, kCoulomb, kBias, kBaseColumns };
using Theta = Eigen::Matrix<double, kBaseColumns, 1>;

}  // namespace towbench::harness::diagnose
