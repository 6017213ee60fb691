// Forces of terms that the supplied model has beyond M, B, C and bias, along the measured motion.
//
// They are taken off the input before anything is tested, so that a model is not told to have what
// it already has: break-away and Stribeck (3.25)/(3.26), position friction (3.34), chain (3.37).
#pragma once

#include <Eigen/Core>

#include "harness/diagnose/nominal_model.h"
#include "harness/diagnose/signals.h"

namespace towbench::harness::diagnose {

// Empty when the model has no such term.
[[nodiscard]] Eigen::VectorXd known_force_N(const NominalModel& model, const Signals& signals);

}  // namespace towbench::harness::diagnose
