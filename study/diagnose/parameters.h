// The nominal structure refitted: which of its parameters are not what the model says.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "study/prediction/interval.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

inline constexpr std::array kParameterNames{"inertia", "viscous", "coulomb", "bias"};

struct ParameterShift {
  std::string name;     // one of these
  double supplied = 0;  // load side
  Interval fitted;      // 95 %
  std::string unit;     // load side
  bool moved = false;
  std::vector<std::string> indistinguishable_from;
};

// Their places in the list.
enum BaseParameter : std::size_t { kInertia, kViscousFriction, kDryFriction, kConstantForce };

// A parameter has moved when it lies more than 4 standard errors, 1 % of it and 1 % of the
// input's rms from what was supplied, and no accepted cause shares its mean with it; inertia and
// viscous friction beside a cause only if the log is predicted surely worse with them as stated.
// Classes: {inertia, added_mass}; all by one ratio: {amplifier_gain}; inertia and viscous by one
// ratio, Coulomb as stated: {encoder_count_loss}, or both where the data allow either; Coulomb by
// another ratio: {amplifier_gain} beside it, two things; inertia too little to move, but off by the
// ratio of Coulomb and viscous: {amplifier_gain} of these; bias: {constant_bias,
// coulomb_asymmetry}. `some_left_out`: the runs are those that are left of several, and may differ
// from these.
[[nodiscard]] std::vector<ParameterShift> judge_parameters(const Data& data, const Search& search,
                                                           bool some_left_out);

// To alternatives that may hold it already.
void add_once(std::vector<std::string>& names, const std::string& name);

// Whether a wrong gain may stand behind the shifts of inertia, viscous and dry friction.
[[nodiscard]] bool may_be_gain(const std::vector<ParameterShift>& shifts);
// The same of a weight that is fitted as `sine_Nm` and `cosine_Nm`: both are off from what is
// stated by the ratio by which inertia is.
[[nodiscard]] bool may_be_gain(const std::vector<ParameterShift>& shifts, const Interval& sine_Nm,
                               const Interval& cosine_Nm, const Parameters& stated);

}  // namespace towbench::study::diagnose
