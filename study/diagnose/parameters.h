// The nominal structure refitted: which of its parameters are not what the model says.
#pragma once

#include <string>
#include <vector>

#include "study/diagnose/evidence.h"
#include "study/diagnose/heldout.h"

namespace towbench::harness::diagnose {

inline constexpr double kMovedErrors = 4;    // standard errors (HAC)
inline constexpr double kMovedShare = 0.01;  // of the force's rms

struct ParameterShift {
  std::string name;     // inertia, viscous, coulomb, bias
  double supplied = 0;  // load side
  Interval fitted;      // 95 %
  std::string unit;     // load side
  bool moved = false;
  std::vector<std::string> indistinguishable_from;
};

// Of an elastic axis it must have moved by kElasticFloor of itself too.
// A parameter has moved when it lies more than 4 standard errors (HAC) and 1 % of the model's
// whole force rms from what was supplied, and no accepted cause shares its mean with it.
// Classes: {inertia, added_mass}; all by one ratio: {amplifier_gain}; inertia and viscous by one
// ratio, Coulomb not: {encoder_count_loss}; Coulomb by another: {amplifier_gain} beside it, two
// things; bias: {constant_bias, coulomb_asymmetry}.
[[nodiscard]] std::vector<ParameterShift> judge_parameters(const NominalModel& model,
                                                           const Evidence& evidence,
                                                           const std::vector<Term>& causes);

// How many things the shifts say are wrong: what has one cause is one thing.
[[nodiscard]] std::size_t things_moved(const std::vector<ParameterShift>& shifts);

// The one effect that stands behind several shifts, by name; empty when there is none.
[[nodiscard]] std::string common_cause(const std::vector<ParameterShift>& shifts);

}  // namespace towbench::harness::diagnose
