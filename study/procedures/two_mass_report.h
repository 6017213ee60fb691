// What a fit of the two-mass model to a recording shows: estimates with intervals, ordinary least
// squares beside it with its criteria and its own bias, measured against simulated.
#pragma once

#include <string>
#include <vector>

#include "study/identify/output_error.h"
#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

// What the model leaves, an estimate of its own: later experiments rest on that model.
inline constexpr const char* kLeftByPulses = "model_left_counts";

struct TwoMassReport {
  const ProcedureContext& context;
  const identify::Recording& data;
  const identify::TwoMassFit& fit;
  bool knots_are_bends = false;  // they stand where friction was seen to bend
  std::string procedure;         // id that the estimates carry
  std::string input;             // what drove the axis, for the criteria's title
};

// Why there is no model; empty: there is one, right or wrong.
[[nodiscard]] std::string unexplained(const identify::TwoMassFit& fit);
// More than two counts: the model's structure is wrong, and its intervals are as wide as that asks.
[[nodiscard]] bool leaves_much(const identify::TwoMassFit& fit);

void report_two_mass(const TwoMassReport& report, ProcedureOutcome& outcome);

}  // namespace towbench::study::procedures
