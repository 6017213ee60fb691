// Forces of terms that the supplied model has beyond M, B, C and bias, along the measured motion.
//
// They are taken off the input before anything is tested, so that a model is not told to have what
// it already has: break-away and Stribeck (3.25)/(3.26), position friction (3.34).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "study/diagnose/nominal_model.h"
#include "study/diagnose/signals.h"

namespace towbench::harness::diagnose {

// Empty when the model has no such term, and for an elastic axis, whose own law has them
// (elastic_axis.h).
[[nodiscard]] Eigen::VectorXd known_force_N(const NominalModel& model, const Signals& signals);

// The same, noted in each run, to be taken off its input.
void take_off_known_terms(std::vector<Run>& runs, const Baseline& baseline,
                          const Conditioning& conditioning);

// Of break-away's excess over Coulomb friction, what is left at a speed.
[[nodiscard]] double stribeck_share(const NominalModel& model, double speed_m_per_s);
// Piecewise linear, constant beyond the ends. `at` ascends and is not empty.
[[nodiscard]] double interpolated(const std::vector<double>& at, const std::vector<double>& value,
                                  double x);

}  // namespace towbench::harness::diagnose
