// What a run is judged against: the stated model, and where it is linearised.
//
// A rigid axis is linear in its coefficients. An elastic one is not: its base columns are the
// derivatives of its force at `at`, which follows the fit (diagnosis.cc).
#pragma once

#include "study/diagnose/nominal_model.h"
#include "study/diagnose/theta.h"

namespace towbench::harness::diagnose {

// How a chain differs from the stated one: ratios of stiffness and damping, metres of play.
enum ChainPart : Eigen::Index { kStiffness, kDamping, kPlay, kChainParts };
using ChainShift = Eigen::Matrix<double, kChainParts, 1>;

struct Baseline {
  NominalModel model;
  Theta at = Theta::Zero();
  // Of the chain that the load is read with. Like `at` a point of linearisation: columns are taken
  // there, their coefficients are counted from what was stated.
  ChainShift read = ChainShift::Zero();
};

[[nodiscard]] inline ElasticChain shifted(ElasticChain chain, const ChainShift& by) {
  chain.stiffness_N_per_m *= 1 + by[kStiffness];
  chain.damping_N_s_per_m *= 1 + by[kDamping];
  chain.play_m += by[kPlay];
  return chain;
}

// Share of the force below which nothing is named of an elastic axis: the chain's force,
// differentiated twice, leaves this much of a machine as stated.
inline constexpr double kElasticFloor = 0.005;

[[nodiscard]] inline Baseline stated_baseline(const NominalModel& model) {
  return {model, Theta(model.mass_kg, model.viscous_N_s_per_m, model.coulomb_N, model.bias_N)};
}

}  // namespace towbench::harness::diagnose
