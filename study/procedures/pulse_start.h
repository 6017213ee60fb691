// Where the fit of the pulse responses begins: knots and levels of friction from the
// torque-position map, its rise towards standstill from the break-away map, the rest from the
// controller's belief.
#pragma once

#include "study/identify/output_error.h"
#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

// `spacing_m`: of the knots where no map was made.
[[nodiscard]] identify::TwoMassStart pulse_start(const ProcedureContext& context,
                                                 const identify::Recording& data, double spacing_m);

}  // namespace towbench::study::procedures
