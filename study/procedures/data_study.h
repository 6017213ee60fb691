// Parameters from a log that a user brings: nothing is moved, nothing is asked of a machine. Least
// squares as the thesis has it and output error of the two-mass model, as EXP-OL-2 does them.
#pragma once

#include "study/procedures/brought_log.h"
#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

// `context.known` is empty or holds what else is known of the machine. Fails, with the reason, when
// the model does not explain the log: estimates are then withheld.
[[nodiscard]] ProcedureOutcome study_log(const ProcedureContext& context, const BroughtLog& log);

}  // namespace towbench::study::procedures
