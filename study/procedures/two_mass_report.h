// What a fit of the two-mass model to a recording shows: estimates with intervals, ordinary least
// squares beside it with its criteria and its own bias, measured against simulated.
#pragma once

#include <string>
#include <vector>

#include "study/identify/output_error.h"
#include "study/procedures/procedure.h"

namespace towbench::harness::procedures {

struct TwoMassReport {
  const ProcedureContext& context;
  const identify::Recording& data;
  const identify::TwoMassFit& fit;
  bool knots_are_bends = false;  // they stand where friction was seen to bend
  std::string procedure;         // id that the estimates carry
  std::string input;             // what drove the axis, for the criteria's title
};

// Why the model does not explain the data; empty: it does.
[[nodiscard]] std::string unexplained(const identify::TwoMassFit& fit);

void report_two_mass(const TwoMassReport& report, ProcedureOutcome& outcome);

}  // namespace towbench::harness::procedures
